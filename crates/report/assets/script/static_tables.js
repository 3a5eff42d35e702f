// Tables that stand whole in the document: their rows are put in another order, or hidden.

/** Shorter tables are looked through by eye. */
const FILTERED_FROM = 12;

function startStaticTable(table) {
  const body = table.tBodies[0];
  const rows = [...body.rows];
  const summaries = rows.filter((row) => row.classList.contains("summary"));
  const plain = rows.filter((row) => !row.classList.contains("summary"));
  if (plain.length < 2) return;
  const headings = [...table.tHead.rows[0].cells];
  const key = (row, column) => {
    const text = row.cells[column].textContent.trim();
    return headings[column].classList.contains("number") ? numberIn(text) : text || null;
  };
  const order = new Rows(plain, key, (row) => row.textContent);
  const count = element("p", { class: "count", role: "status", hidden: true });
  const show = () => {
    const places = order.places();
    const untouched = order.column === null && places.length === plain.length;
    // Means stand under the rows that they are of, or below all where those have moved.
    body.replaceChildren(...(untouched ? rows : [...places.map((place) => plain[place]), ...summaries]));
    count.hidden = places.length === plain.length;
    count.textContent = count.hidden ? "" : `${places.length} of ${plain.length} rows; means are of all rows.`;
  };
  const sort = (column) => {
    order.sortBy(column);
    show();
  };
  sortableHeaders(headings, sort, () => order);
  if (plain.length < FILTERED_FROM) return;
  const find = (words) => {
    order.search(words);
    show();
  };
  const tools = element("div", { class: "tools single" }, searchField("Filter rows", "filter", find));
  table.parentElement.before(tools, count);
}
