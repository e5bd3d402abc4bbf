// The page in a browser: the address, what is kept, and the socket, which is opened again when it breaks.

import {mount} from "./page.js";

const FIRST = 250, LONGEST = 5000; // ms
const NOT_LET_IN = [1008, 1013];

export class Transport {
  /**
   * @param {string} address
   * @param {{open: () => void, text: (text: string) => void, bytes: (bytes: ArrayBuffer) => void, lost: () => void, over: (reason: string) => void}} hands
   */
  constructor(address, hands) {
    this.address = address;
    this.hands = hands;
    this.wait = FIRST;
    this.over = false;
    this.#open();
  }

  #open() {
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.hands.open();
    socket.onmessage = ({data}) => {
      this.wait = FIRST;
      if (typeof data === "string") this.hands.text(data);
      else this.hands.bytes(data);
    };
    socket.onclose = ({code, reason}) => {
      if (this.over) return;
      if (NOT_LET_IN.includes(code)) {
        this.over = true;
        this.hands.over(reason);
        return;
      }
      this.hands.lost();
      setTimeout(() => this.#open(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST);
    };
    this.socket = socket;
  }

  /** @param {object} message */
  send(message) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}

const KEPT = "assoc-hull page", AUTHOR = "assoc-hull author";

/** What the address says behind #; it is taken out of the address bar, and kept for a reload. */
function admission() {
  const given = new URLSearchParams(location.hash.slice(1));
  if (given.has("t")) {
    sessionStorage.setItem(KEPT, given.toString());
    history.replaceState(null, "", location.pathname);
    return given;
  }
  return new URLSearchParams(sessionStorage.getItem(KEPT) ?? "");
}

const root = /** @type {HTMLElement} */ (document.querySelector(".page"));
const given = admission();
const author = localStorage.getItem(AUTHOR) || given.get("author") || "designer";
mount(root, {
  token: given.get("t") ?? "",
  author,
  upload: (file) => fetch(`drop?name=${encodeURIComponent(file.name)}`, {method: "POST", body: file, headers: {"X-Token": given.get("t") ?? ""}}).then((answer) => {
    if (answer.headers.get("content-type")?.startsWith("application/json")) return answer.json();
    return {problem: answer.status === 403 ? "the address is that of another server: open the new one" : `the server answered ${answer.status}: try again`};
  }),
  connect: (hands) => new Transport(`ws://${location.host}/socket`, hands),
  keep: (name, value) => localStorage.setItem(`assoc-hull ${name}`, value),
  kept: (name) => localStorage.getItem(`assoc-hull ${name}`),
});
