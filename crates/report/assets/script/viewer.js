// One row: its pictures with the marks, and everything that is known of it.

const KEYS = "Keys: \u2190 and \u2192 for the row before and after, m for marks, + and \u2212 for the size, Escape to close.";

class Viewer {
  constructor(dialog, measurements) {
    this.dialog = dialog;
    this.measurements = measurements;
    this.withMarks = true;
    this.zoom = 1;
    this.view = null;
    this.title = element("h2", { id: "viewer-title" });
    this.picture = element("div", { class: "viewer-scroll", tabindex: "0", role: "region", "aria-label": "Picture" });
    this.tools = element("div", { class: "viewer-tools" });
    this.facts = element("div", { class: "viewer-facts", tabindex: "0", role: "region", "aria-label": "What is known of the row" });
    const button = (text, click) => element("button", { type: "button", class: "control", click }, text);
    [this.back, this.forth] = [button("\u2190 Previous", () => this.step(-1)), button("Next \u2192", () => this.step(1))];
    dialog.append(
      element("header", {}, this.title, this.back, this.forth, button("Close", () => dialog.close())),
      element("div", { class: "viewer-body" }, element("div", { class: "viewer-picture" }, this.picture, this.tools), this.facts));
    dialog.addEventListener("keydown", (event) => this.key(event));
    dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
    dialog.addEventListener("close", () => this.picture.replaceChildren());
  }

  /** Opens a row of a table, by its place among those that are left after filtering. */
  open(table, at) {
    this.table = table;
    this.show(at);
    this.dialog.showModal();
    this.forth.focus();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    const acts = {
      ArrowLeft: () => this.step(-1),
      ArrowRight: () => this.step(1),
      m: () => this.toggleMarks(),
      "+": () => this.scale(this.zoom * 1.5),
      "-": () => this.scale(this.zoom / 1.5),
      0: () => this.scale(1),
    };
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }

  step(by) {
    const next = this.at + by;
    if (next >= 0 && next < this.table.places.length) this.show(next);
  }

  toggleMarks() {
    this.withMarks = !this.withMarks;
    this.showPicture();
  }

  scale(zoom) {
    this.zoom = Math.min(8, Math.max(1, zoom));
    const shown = this.picture.querySelector(".stage");
    if (shown) shown.style.width = `${100 * this.zoom}%`;
  }

  show(at) {
    this.at = at;
    this.row = this.measurements.grid.rows[this.table.places[at]];
    this.pictures = this.measurements.pictures(this.row);
    const text = (name) => this.measurements.text(this.row, name);
    const place = `${text("session")}, row ${whole.format(at + 1)} of ${whole.format(this.table.places.length)}`;
    this.title.replaceChildren(`${text("object")}: ${text("quantity")} by ${text("rater")}`, element("small", {}, place));
    this.back.disabled = at === 0;
    this.forth.disabled = at === this.table.places.length - 1;
    // The same view as of the row before, where this one has it.
    this.chosen = Math.max(0, this.pictures.findIndex((picture) => picture.view === this.view));
    this.zoom = 1;
    this.showPicture();
    this.showFacts();
  }

  showPicture() {
    const picture = this.pictures[this.chosen];
    if (!picture) {
      const why = "No picture of this row is in the report.";
      this.picture.replaceChildren(element("p", { class: "empty" }, why));
      this.tools.replaceChildren();
      return;
    }
    const shown = stage(picture, this.measurements.about(this.row), this.withMarks);
    this.picture.replaceChildren(shown);
    this.scale(this.zoom);
    this.showTools();
  }

  showTools() {
    const button = (text, click, pressed = false) =>
      element("button", { type: "button", class: "control", click, "aria-pressed": pressed === null ? false : String(pressed) }, text);
    const label = ({ image, view }) => `${VIEWS[view]}: ${image.split("/").at(-1)}`;
    const option = (picture, place) => element("option", { value: place, selected: place === this.chosen }, label(picture));
    const list = element("select", { class: "control", name: "picture", "aria-label": "Picture" }, ...this.pictures.map(option));
    list.addEventListener("change", () => {
      this.chosen = Number(list.value);
      this.view = this.pictures[this.chosen].view;
      this.showPicture();
    });
    // What had the keyboard has it again.
    const focused = [...this.tools.children].indexOf(document.activeElement);
    this.tools.replaceChildren(list,
      button("Marks", () => this.toggleMarks(), this.withMarks),
      button("Larger", () => this.scale(this.zoom * 1.5), null), button("Smaller", () => this.scale(this.zoom / 1.5), null));
    this.tools.children[focused]?.focus();
  }

  showFacts() {
    const { grid } = this.measurements;
    const facts = grid.columns.map((column, place) => {
      const text = cellText(grid, column, this.row[place]);
      return text ? element("div", {}, element("dt", { title: column.meaning || false }, column.heading), element("dd", {}, text)) : null;
    });
    this.facts.replaceChildren(element("dl", {}, ...facts.filter(Boolean)), element("p", { class: "keys" }, KEYS));
    this.facts.scrollTop = 0;
  }
}
