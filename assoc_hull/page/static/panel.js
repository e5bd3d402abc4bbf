// The panel at the right: the point, its curve, what the edit does, who signs.

import {button, form, link, make, paragraph} from "./elements.js";
import {ACTIONS, keyWords} from "./actions.js";
import {Numbers} from "./hydrostatics.js";
import {Past, WhyPanel} from "./history.js";
import {arcLength, inflections} from "./hermite.js";
import {farthest, farthestDrawn} from "./paint.js";
import {Beside, Files} from "./files.js";
import {Fairing} from "./fair.js";
import {Vary} from "./vary.js";
import {LineChoice, PointTable, Problems} from "./lists.js";
import {PointActs, roleChoice} from "./point_acts.js";
import {Proposal, farWords} from "./propose.js";
import {CROSSING} from "./net.js";
import {VOLUME, count, millimetres, signed, typedNumber} from "./units.js";

const AXES = ["x", "y", "z"];
const WAYS = ["forward of AP", "from the centre plane", "above the base line"];
const PLANES = /** @type {Record<string, [number, number]>} */ ({sections: [1, 2], frames: [1, 2], waterlines: [0, 1], diagonals: [0, 1]});
const OPEN = ["Proposal", "Point", "Curve", "Edit", "Pull", "Signed as"];

export class Panel {
  /** @param {Page} page @param {HTMLElement} element */
  constructor(page, element) {
    this.page = page;
    this.parts = Object.fromEntries(["Proposal", "Point", "Curve", "Edit", "Pull", "Why", "History", "Hydrostatics", "Fair", "Vary", "Points", "Problems", "Export", "Beside", "Signed as"].map((title) => {
      const body = make("div"), box = make("details", {open: OPEN.includes(title)}, make("summary", {}, make("h2", {textContent: title})), body);
      box.ontoggle = () => {
        const asker = [this.why, this.numbers].find((each) => each.box === body);
        if (asker) asker.led = box.open;
        page.store.changed("panel");
      };
      element.append(box);
      return [title, body];
    }));
    /** While something in it is pressed it stands still: what moved away under the pointer would not be clicked. */
    this.pressed = false;
    /** @type {any[]} */
    this.waiting = [];
    // A list that is opened, a scroll bar and a menu of the browser keep for themselves that the pointer is let go.
    element.addEventListener("pointerdown", ({button, target}) => this.pressed = button === 0 && target instanceof Element && target.closest("button, summary, label") !== null);
    // A button that is let go elsewhere is known by the next move, or by a key.
    for (const event of ["pointerup", "pointercancel", "pointermove", "keydown", "dragend"]) element.ownerDocument.addEventListener(event, (each) => {
      if (this.pressed && !(each instanceof PointerEvent && each.buttons)) setTimeout(() => this.#release());
    }, {capture: true, signal: page.options.within});
    addEventListener("blur", () => { if (this.pressed) this.#release(); }, {signal: page.options.within});
    /** @type {HTMLInputElement[]} */
    this.fields = [];
    this.shownRow = /** @type {number | null | undefined} */ (undefined);
    this.shownState = -1;
    this.pointBox = make("div");
    this.curveBox = make("div");
    this.parts.Point.append(this.pointBox);
    this.acts = new PointActs(page, this.parts.Point);
    this.lines = new LineChoice(page, this.parts.Curve);
    this.parts.Curve.append(this.curveBox);
    this.#signature();
    this.points = new PointTable(page, this.parts.Points);
    this.vary = new Vary(page, this.parts.Vary);
    this.problems = new Problems(page, this.parts.Problems);
    this.proposal = new Proposal(page, this.parts.Proposal);
    this.why = new WhyPanel(page, this.parts.Why);
    this.past = new Past(page, this.parts.History);
    this.numbers = new Numbers(page, this.parts.Hydrostatics);
    this.fair = new Fairing(page, this.parts.Fair);
    this.files = new Files(page, this.parts.Export);
    /** All that ask the server: an answer is for one of them. */
    this.askers = [this.proposal, this.why, this.past, this.numbers, this.fair, this.vary, this.problems, this.files];
    this.beside = new Beside(page, this.parts.Beside);
    this.radii = [0, 1].map((i) => this.#radius(i));
    const made = this.#switches(["fair-pull", "pinned", "insert", "reshape", "fair-shape"]), ofPoint = this.#switches(["knuckle", "smooth", "tangent", "pin", "delete"]);
    this.switches = [...made, ...ofPoint];
    this.pointForm = form(...ofPoint.map(({found}) => found));
    this.acts.add(this.pointForm);
    this.#table(this.parts.Pull, [["along the length, m", this.radii[0]], ["around the girth, m", this.radii[1]]]);
    this.parts.Pull.append(form(...made.map(({found}) => found)));
  }

  /** Buttons of actions. @param {string[]} ids */
  #switches(ids) {
    return ids.map((id) => {
      const action = /** @type {Action} */ (ACTIONS.find((each) => each.id === id)), found = button(action.label?.(this.page) ?? "", () => action.run(this.page));
      found.dataset.action = id;
      found.title = `${action.words} (${action.keys.map(keyWords).join(", ")})`;
      return {action, found};
    });
  }

  /** @param {number} i */
  #radius(i) {
    const field = make("input"), {store} = this.page;
    field.inputMode = "decimal";
    field.setAttribute("aria-label", i ? "radius of a pull around the girth, m" : "radius of a pull along the length, m");
    field.onchange = () => {
      const value = typedNumber(field), radius = [...(store.tools.radius ?? [1, 1])];
      if (!(value > 0 && value < 1000)) this.page.say("A radius is a number of metres above 0, such as 12.5");
      else radius[i] = value;
      store.tools.radius = radius;
      store.changed("panel");
    };
    return field;
  }

  render() {
    const radius = this.page.store.tools.radius;
    for (const {action, found} of this.switches) {
      found.disabled = !(action.enabled?.(this.page) ?? true);
      if (action.pressed) found.setAttribute("aria-pressed", String(action.pressed(this.page)));
    }
    this.radii.forEach((field, i) => {
      if (radius && field !== document.activeElement) field.value = radius[i].toFixed(1);
    });
    this.#point();
    this.acts.render();
    this.lines.render();
    this.#curve();
    this.#edit();
    this.points.render();
    for (const each of this.askers) each.render();
  }

  /** An answer is shown by those it is for. @param {any} message */
  answer(message) {
    if (this.pressed) this.waiting.push(message);
    else for (const each of this.askers) {
      const mine = each.asked === message.id;
      each.answer(message);
      if (mine) each.bring();
    }
  }

  #release() {
    this.pressed = false; // after the click
    for (const message of this.waiting.splice(0)) this.answer(message);
    this.page.store.changed("panel");
  }

  /** Opens a part, and gives it the focus. @param {string} title */
  open(title) {
    const box = this.parts[title].closest("details");
    if (!box) return;
    box.open = true;
    box.querySelector("summary")?.focus();
    this.render();
    box.scrollIntoView({block: "nearest"});
  }

  /** @param {HTMLElement} box @param {[string, string | Node][]} rows */
  #table(box, rows) {
    box.replaceChildren(make("dl", {}, ...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)])));
  }

  /** @param {HTMLElement} box @param {string} words */
  #words(box, words) { box.replaceChildren(paragraph(words)); }

  #point() {
    const {store} = this.page, box = this.pointBox, row = store.held?.row ?? store.selection.row;
    const point = row === null ? undefined : store.net?.points.get(row), place = row === null ? undefined : store.placeOf(row);
    if (!point || !place || !store.net) {
      this.shownRow = null;
      return this.#words(box, "Click a point, or press / and type its name.");
    }
    const same = this.shownRow === row && this.shownState === store.state && this.fields.length > 0 && box.contains(this.fields[0]);
    if (same) {
      this.fields.forEach((field, i) => {
        if (field !== document.activeElement && !field.dataset.typed) field.value = place[i].toFixed(4);
      });
      const moved = box.querySelector(".moved");
      if (moved) moved.textContent = this.#movedWords(row);
      return;
    }
    const role = store.net.roleWords(point), moved = make("span", {className: "moved", title: "Off the hull and along it together", textContent: this.#movedWords(row)});
    // What is typed stays when somebody else has edited the hull meanwhile.
    const old = this.shownRow === row ? this.fields : [], at = old.findIndex((field) => field === document.activeElement);
    this.fields = AXES.map((name, i) => this.#field(point, name, i, place[i]));
    this.fields.forEach((field, i) => {
      if (!old[i]?.dataset.typed || field.readOnly) return;
      field.value = old[i].value;
      field.dataset.typed = "yes";
    });
    this.#table(box, [
      ["name", point.label || store.said(point.name)],
      ["kind", store.net.sortWords(point)],
      ["role", point.driver >= 0 ? link(role, () => store.select(null, point.driver)) : role],
      ["line passes", store.net.kindWords(point)],
      ...AXES.map((name, i) => /** @type {[string, Node]} */ ([`${name}, m`, this.fields[i]])),
      ["point moved", moved],
    ]);
    this.pointForm.querySelector("select")?.remove();
    if (point.sort === CROSSING) this.pointForm.append(roleChoice(this.page, point));
    this.shownRow = row;
    this.shownState = store.state;
    if (at >= 0) this.fields[at].focus();
  }

  /** How far the chosen point moves in the hand, or has moved by the last edit. @param {number | null} row */
  #movedWords(row) {
    const movement = this.page.store.movement, now = row === null ? undefined : movement?.now.places.get(row), then = row === null ? undefined : movement?.then.places.get(row);
    const far = now && then ? Math.hypot(now[0] - then[0], now[1] - then[1], now[2] - then[2]) : 0;
    return far > 0 ? millimetres(far) + movement?.words : "not moved";
  }

  /** How far the chosen line does, at most. @param {number} id */
  #lineMovedWords(id) {
    const movement = this.page.store.movement, now = movement?.now.curves.get(id), then = movement?.then.curves.get(id);
    const far = movement && now && then ? farthest(/** @type {any} */ ({curves: new Map([[id, now]])}), movement.then.curves) : 0;
    return far > 1e-9 ? `${millimetres(far)} at most, in its plane${movement?.words}` : "not moved";
  }

  /** @param {Point} point @param {string} name @param {number} axis @param {number} value */
  #field(point, name, axis, value) {
    const field = make("input", {inputMode: "decimal"});
    field.value = value.toFixed(4);
    field.setAttribute("aria-label", `${name}, m, ${WAYS[axis]}`);
    field.title = WAYS[axis];
    field.readOnly = !point.free.includes(name);
    if (field.readOnly) {
      field.tabIndex = -1;
      field.title += point.free ? `; it lies in a plane: free is ${[...point.free].join(", ")}` : "; it is computed";
    }
    field.onkeydown = (event) => {
      if (event.key === "Enter") this.#enter(point);
    };
    field.oninput = () => {
      field.dataset.typed = "yes";
      this.page.say("Enter makes the edit, Esc leaves the point where it is.");
    };
    field.onblur = () => this.page.store.changed("panel");
    return field;
  }

  /** @param {Point} point */
  #enter(point) {
    const values = Object.fromEntries([...point.free].map((name) => [name, typedNumber(this.fields[AXES.indexOf(name)])]));
    const {tools} = this.page.store;
    const wrong = Object.entries(values).find(([, value]) => !Number.isFinite(value));
    if (wrong) return this.page.say(`${wrong[0]} is no number of metres: type one such as 6.953`);
    const {page} = this;
    if (point.sort !== CROSSING && !tools.pinned) return page.panel.proposal.show(`lead ${page.store.net?.curveName(point.a)} by ${point.name}`, [{op: "move", point: point.name, ...values, lead: true}]);
    for (const field of this.fields) delete field.dataset.typed;
    page.apply(`place ${point.name} at ${Object.entries(values).map(([name, value]) => `${name} ${value}`).join(", ")}`, [{op: "move", point: point.name, ...values}]);
  }

  #curve() {
    const {store} = this.page, box = this.curveBox, id = store.selection.curve, net = store.net;
    const line = id === null ? undefined : net?.lineOf(id), was = id === null ? undefined : store.curves.get(id), now = id === null ? undefined : store.curveNow(id);
    if (id === null || !net || !line || !was || !now) return this.#words(box, "Click a line, or choose it here.");
    const [a, b] = PLANES[line.family] ?? [0, 2], before = inflections(was, a, b).length, after = inflections(now, a, b).length;
    const count = make("span", {textContent: before === after ? `${after}` : `${after}, was ${before}`, className: after > before ? "hot" : ""});
    this.#table(box, [
      ["name", net.curveName(id)],
      ["family", line.family],
      ...(line.offset === null ? [] : [/** @type {[string, string]} */ (["plane", `${AXES[line.axis ?? 0]} = ${line.offset.toFixed(3)} m`])]),
      ["length", `${arcLength(now).toFixed(3)} m`],
      ["points", `${now.n} define it, ${net.rowsOf.get(id)?.length ?? 0} lie on it`],
      ["inflections", count],
      ["line moved", this.#lineMovedWords(id)],
    ]);
  }

  #edit() {
    const {store} = this.page, box = this.parts.Edit, {overlay, held, last} = store;
    if (held?.refused) return this.#table(box, [["refused", "the reason stands beside the point; lines stay where they could follow last"]]);
    if (overlay && (held || this.page.hand.committing)) {
      const {frame} = overlay;
      return this.#table(box, [
        ["follow", `${count(frame.curves.size, "curve")}, ${count(frame.places.size, "point")}`],
        ["hull moves", farWords(frame.normal, frame.normal < 1e-9 ? farthestDrawn(frame, store.curves) : 0) || "nowhere"], // lines are told one by one
        [VOLUME, `about ${signed(frame.volume, 2, "m³")}`],
        ["LCB", `about ${signed(frame.lcb, 4, "m")}`],
      ]);
    }
    if (!last) return this.#words(box, "Drag a point: all lines that follow move with it. Esc takes it back.");
    const {undo, redo} = store.history;
    // What was told of an edit is no longer so once it is taken back.
    if (last.state !== store.state) return this.#table(box, [["last", undo === null ? "none: the hull is as it came" : store.said(undo)], ...(redo === null ? [] : [/** @type {[string, string]} */ (["taken back", store.said(redo)])])]);
    this.#table(box, [
      ["last", store.said(last.name)],
      ...(last.author ? [/** @type {[string, string]} */ (["made by", last.author])] : []),
      ["follow", count(last.relofted, "curve")],
      ["hull moved", farWords(last.normal, last.drawn) || "nowhere"],
      ["inflections", last.inflections ? `${last.inflections} new` : "none new"],
      ...last.notes.slice(0, 4).map((/** @type {string} */ note) => /** @type {[string, string]} */ (["note", store.said(note)])),
    ]);
  }

  #signature() {
    const {page} = this, field = make("input", {ariaLabel: "name that your edits are signed with"});
    field.value = page.options.author;
    field.maxLength = 80;
    field.onchange = () => {
      page.sign(field.value);
      field.value = page.store.author;
    };
    this.parts["Signed as"].append(field, paragraph("Undo takes back what this name has signed."));
  }
}
