// What the page asks of its server: addresses count from the page's own, which holds the token.

export class Fault extends Error {
  constructor(text, status) {
    super(text);
    this.status = status;
  }
}

async function answer(response) {
  if (response.ok) return response;
  const text = await response.text();
  let fault = text;
  try {
    fault = JSON.parse(text).fault ?? text;
  } catch {
    /* plain words */
  }
  throw new Fault(fault || `the server answers ${response.status}`, response.status);
}

async function sent(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw new Fault("the server is gone: start rvwear workbench again, and open the address that it prints");
  }
  return answer(response);
}

export const get = async (path) => (await sent(path)).json();
export const post = async (path, body = {}) => (await sent(path, { method: "POST", body: JSON.stringify(body) })).json();
export const drop = async (path) => (await sent(path, { method: "DELETE" })).json();
export const put = async (path, body) => (await sent(path, { method: "PUT", body })).json();
export const numbers = async (path) => new Float32Array(await (await sent(path)).arrayBuffer());

// Words as JSON in the first line, rows of numbers behind it.
export async function wordsAndRows(path, body, rows) {
  const buffer = await (await sent(path, { method: "POST", body: JSON.stringify(body) })).arrayBuffer();
  const bytes = new Uint8Array(buffer);
  const end = bytes.indexOf(10);
  const words = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
  const all = new Float32Array(buffer.slice(end + 1));
  return [words, Array.from({ length: rows }, (_, i) => all.subarray(i * words.count, (i + 1) * words.count))];
}

// A script of this server, loaded once.
const loaded = new Map();
export function script(path) {
  if (!loaded.has(path))
    loaded.set(
      path,
      new Promise((done, failed) => {
        const element = document.createElement("script");
        element.src = path;
        element.onload = done;
        element.onerror = () => {
          loaded.delete(path);
          failed(new Fault(`${path} could not be loaded`));
        };
        document.head.append(element);
      }),
    );
  return loaded.get(path);
}
