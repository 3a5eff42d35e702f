// The page of rows that is shown as pictures: a bad mark shows at a glance.

class Sheet {
  constructor(table, measurements, open) {
    this.table = table;
    this.measurements = measurements;
    this.openRow = open;
    this.list = element("ul", { class: "sheet", hidden: true });
    const button = (text, on) => element("button", { type: "button", class: "control", "aria-pressed": String(!on), click: () => this.turn(on) }, text);
    this.buttons = [button("Rows", false), button("Pictures", true)];
    this.switch = element("div", { class: "end", role: "group", "aria-label": "Show measurements as" }, ...this.buttons);
    this.list.addEventListener("click", (event) => {
      const item = event.target.closest("li");
      if (item) open(table.page * table.pageRows + [...this.list.children].indexOf(item));
    });
    table.onUpdate(() => this.show());
  }

  turn(on) {
    this.list.hidden = !on;
    this.table.scroll.hidden = on;
    this.buttons.forEach((button, place) => button.setAttribute("aria-pressed", String(Boolean(place) === on)));
    this.show();
  }

  show() {
    if (this.list.hidden) {
      this.list.replaceChildren();
      return;
    }
    this.list.replaceChildren(...this.table.visible().map((place) => this.item(this.measurements.grid.rows[place])));
  }

  item(row) {
    const text = (name) => this.measurements.text(row, name);
    const picture = this.measurements.pictures(row)[0];
    const [size, sigma, error] = [text("predicted_mm"), text("sigma_mm"), text("error_pct")];
    const sized = size && (sigma ? `${size} \u00b1 ${sigma} mm` : `${size} mm`);
    const facts = [sized, error && `(${error} %)`].filter(Boolean).map((fact) => fact.replaceAll(" ", "\u00a0")).join(" ");
    const about = [text("quantity"), text("method"), text("rater"), text("session")].join(", ");
    return element("li", {}, element("button", { type: "button" },
      picture ? stage(picture, this.measurements.about(row)) : null,
      element("span", { class: "text" }, element("strong", {}, text("object")), ` ${facts || "not measured"}`, element("small", {}, about))));
  }
}
