// Draws a draft first of all, then loads the rest of the page and draws the final picture.
import { request } from "./request.js";
import { draw, open } from "./picture.js";
import { state } from "./state.js";

const PATIENCE = 1000; // milliseconds that the rest waits for the draft on a slow connection

let drafted;
const draft = new Promise((resolve) => (drafted = resolve));

/** Resolves when the final picture is drawn, or an error is shown instead. */
export const whole = open(state.mesh, {}, async () => {
  await draw(true);
  drafted();
  request("startThreads");
  await draw(false);
});

await Promise.race([draft, whole, new Promise((resolve) => setTimeout(resolve, PATIENCE))]);
import("./app.js");
