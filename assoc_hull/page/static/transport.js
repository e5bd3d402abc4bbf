// The socket to the server: it is opened again when it breaks, sooner at first, then every 5 s.

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
