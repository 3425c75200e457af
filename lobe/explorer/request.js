// Requests to the worker, which draws and computes.

const { worker } = window; // index.html starts it
const waiting = new Map();
let calls = 0;

worker.onmessage = ({ data: { id, result, error } }) => {
  const { resolve, reject } = waiting.get(id);
  waiting.delete(id);
  error === undefined ? resolve(result) : reject(new Error(error));
};

export const request = (call, argument) =>
  new Promise((resolve, reject) => {
    waiting.set(++calls, { resolve, reject });
    worker.postMessage({ id: calls, call, argument });
  });

/** Runs one call at a time; of the calls made meanwhile only the last one follows. */
export function latest(call, failed) {
  let busy = false;
  let again = null;
  return async function run(...values) {
    if (busy) {
      again = values;
      return;
    }
    busy = true;
    await call(...values).catch((error) => failed(error.message));
    busy = false;
    if (again) {
      const next = again;
      again = null;
      run(...next);
    }
  };
}
