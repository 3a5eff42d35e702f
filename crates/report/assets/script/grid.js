// Rows of JSON, of which the document holds one page at a time.

const PAGE_ROWS = 100;
/** A longer table has only its page that is shown printed. */
const MOST_ROWS_ON_PAPER = 2000;

/** What a cell of JSON says, for people. */
function cellText(grid, column, cell) {
  if (cell === null) return "";
  switch (column.kind) {
    case "text": return grid.words[cell];
    case "time": return new Date(cell).toISOString().replace("T", " ").replace("Z", "");
    case "flag": return cell ? "yes" : "no";
    default: return typeof cell === "number" ? cell.toFixed(column.decimals).replace("-", "\u2212") : cell;
  }
}

/** What a cell of JSON is sorted by. */
function cellKey(grid, column, cell) {
  if (cell === null) return null;
  if (column.kind === "text") return grid.words[cell];
  if (typeof cell === "string") return numberIn(cell);
  return column.kind === "magnitude" ? Math.abs(cell) : cell;
}

function isNumber(column) {
  return column.kind === "number" || column.kind === "magnitude";
}

/** A table with pages. `open(place)` is told which of the shown rows was chosen; without it rows only show. */
class GridTable {
  constructor(grid, label, open = null, pageRows = PAGE_ROWS) {
    this.grid = grid;
    this.open = open;
    this.pageRows = pageRows;
    this.shown = grid.columns.map((column, place) => ({ ...column, place })).filter((column) => !column.detail);
    const text = (row) => this.shown.map((column) => cellText(grid, column, row[column.place])).join(" ");
    this.rows = new Rows(grid.rows, (row, column) => cellKey(grid, this.shown[column], row[this.shown[column].place]), text);
    this.page = 0;
    this.listeners = [];
    this.build(label);
  }

  build(label) {
    const heading = (column) =>
      element("th", { scope: "col", class: isNumber(column) && "number", title: column.meaning || false }, column.heading);
    const headings = this.shown.map(heading);
    this.body = element("tbody");
    this.table = element("table", { class: this.open ? "data rows-open" : "data", "aria-label": label },
      element("thead", {}, element("tr", {}, ...headings)), this.body);
    this.scroll = element("div", { class: "scroll tall", tabindex: "0", role: "region", "aria-label": label }, this.table);
    const sort = (column) => {
      this.rows.sortBy(column);
      this.update();
    };
    sortableHeaders(headings, sort, () => this.rows);
    this.count = element("p", { class: "count", role: "status" });
    this.buildPager();
    if (this.open) this.listenToRows();
  }

  buildPager() {
    const turn = (text, by) => element("button", { type: "button", class: "control", click: () => this.turn(by) }, text);
    [this.back, this.forth] = [turn("Previous", -1), turn("Next", 1)];
    this.where = element("span");
    this.pager = element("nav", { class: "pager", "aria-label": "Pages of rows" }, this.back, this.forth, this.where);
  }

  listenToRows() {
    this.body.addEventListener("click", (event) => {
      const row = event.target.closest("tr");
      if (row && getSelection().isCollapsed) this.open(this.page * this.pageRows + row.sectionRowIndex);
    });
    this.body.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      const row = event.target.closest("tr");
      if (!step || !row) return;
      const next = this.body.rows[row.sectionRowIndex + step];
      if (!next) return;
      event.preventDefault();
      next.querySelector("button").focus();
    });
  }

  /** Calls back after every change of what is shown. */
  onUpdate(listener) {
    this.listeners.push(listener);
  }

  /** Takes order and choice anew, and shows the first page. */
  update() {
    this.places = this.rows.places();
    this.page = 0;
    this.show();
  }

  turn(by) {
    this.page += by;
    this.show();
    this.scroll.scrollTop = 0;
    // A button that has just been disabled would lose the keyboard.
    if (this.back.disabled && by < 0) this.forth.focus();
    if (this.forth.disabled && by > 0) this.back.focus();
  }

  /** Row numbers of the page that is shown. */
  visible() {
    const from = this.page === 0 ? 0 : this.page * this.pageRows; // 0 x Infinity is not a number
    return this.places.slice(from, from + this.pageRows);
  }

  show() {
    this.body.replaceChildren(...this.visible().map((place) => this.row(this.grid.rows[place])));
    const [left, all] = [this.places.length, this.grid.rows.length];
    const pages = Math.max(1, Math.ceil(left / this.pageRows));
    this.count.textContent = left === all ? `${whole.format(all)} rows` : `${whole.format(left)} of ${whole.format(all)} rows`;
    this.where.textContent = `Page ${this.page + 1} of ${pages}`;
    this.pager.hidden = pages === 1;
    this.back.disabled = this.page === 0;
    this.forth.disabled = this.page >= pages - 1;
    for (const listener of this.listeners) listener();
  }

  row(row) {
    const cells = this.shown.map((column, index) => {
      const text = cellText(this.grid, column, row[column.place]);
      const title = text.length > 20 && text; // long ones may be cut off
      if (index > 0) return element("td", { class: isNumber(column) && "number", title }, text);
      return element("th", { scope: "row" }, this.open ? element("button", { type: "button" }, text || "row") : text);
    });
    return element("tr", {}, ...cells);
  }
}

/** Paper has no pager. */
function showAllOnPaper(table) {
  if (table.grid.rows.length > MOST_ROWS_ON_PAPER) return;
  const { pageRows } = table;
  let kept = 0;
  addEventListener("beforeprint", () => {
    [kept, table.page, table.pageRows] = [table.page, 0, Infinity];
    table.show();
  });
  addEventListener("afterprint", () => {
    [table.page, table.pageRows] = [kept, pageRows];
    table.show();
  });
}

/** Puts pages in place of the first rows of a long table that stand in the document. */
function startLongTable(table) {
  const grid = dataOf(table.dataset.rows);
  const frame = table.parentElement;
  const heading = document.getElementById(table.getAttribute("aria-labelledby"));
  const paged = new GridTable(grid, heading.textContent);
  const find = (words) => {
    paged.rows.search(words);
    paged.update();
  };
  const tools = element("div", { class: "tools single" }, searchField("Filter rows", "filter", find));
  frame.parentElement.querySelector(".first-rows")?.remove();
  paged.update();
  showAllOnPaper(paged);
  frame.replaceWith(tools, paged.count, paged.scroll, paged.pager);
}
