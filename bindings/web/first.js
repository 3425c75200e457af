// The first picture, a draft, before anything else; then the rest of the page and the whole picture.
import { ask } from "./ask.js";
import { draw, open } from "./picture.js";
import { state } from "./state.js";

const PATIENCE = 1000; // milliseconds that the rest waits for the draft on a slow line

let drafted;
const draft = new Promise((resolve) => (drafted = resolve));

/** When the whole picture is there, or an error in its place. */
export const whole = open(state.mesh, {}, async () => {
  await draw(true);
  drafted();
  ask("startThreads");
  await draw(false);
});

await Promise.race([draft, whole, new Promise((resolve) => setTimeout(resolve, PATIENCE))]);
import("./app.js");
