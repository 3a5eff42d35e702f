// All measurements: a table, or the pictures behind its rows.

/** The measurements by name in place of by place. */
class Measurements {
  constructor(grid, index) {
    this.grid = grid;
    this.index = index;
    this.places = new Map(grid.columns.map((column, place) => [column.name, place]));
    this.images = null;
  }

  /** What a cell says, empty if there is none. */
  text(row, name) {
    const place = this.places.get(name);
    return place === undefined ? "" : cellText(this.grid, this.grid.columns[place], row[place]);
  }

  /** What decides which marks are the row's. */
  about(row) {
    const [session, object, rater, level] = ["session", "object", "rater", "level"].map((name) => this.text(row, name));
    return { session, object, rater, level };
  }

  /** The pictures of a row: of its image, or of the selected images behind a fused size. */
  pictures(row) {
    const image = this.text(row, "image");
    const session = this.text(row, "session");
    if (image) return this.index.of(session, image);
    return this.imagesOf(session, this.text(row, "object")).flatMap((name) => this.index.of(session, name));
  }

  imagesOf(session, object) {
    if (!this.images) {
      this.images = new Map();
      for (const row of this.grid.rows) {
        const image = this.text(row, "image");
        if (!image || this.text(row, "selected") !== "yes") continue;
        const key = JSON.stringify([this.text(row, "session"), this.text(row, "object")]);
        if (!this.images.has(key)) this.images.set(key, new Set());
        this.images.get(key).add(image);
      }
    }
    return [...(this.images.get(JSON.stringify([session, object])) ?? [])];
  }
}

/** Images are called by their file; its folder is in the view of the row. */
function shortImages(grid) {
  const place = grid.columns.findIndex((column) => column.name === "image");
  const words = new Map();
  const short = (word) => {
    if (!words.has(word)) words.set(word, grid.words.push(grid.words[word].split("/").at(-1)) - 1);
    return words.get(word);
  };
  const columns = grid.columns.map((column, at) => (at === place ? { ...column, name: "file" } : column));
  const rows = grid.rows.map((row) => row.map((cell, at) => (at === place && cell !== null ? short(cell) : cell)));
  return { columns, rows, words: grid.words };
}

function startMeasurements(place, index) {
  const grid = dataOf("measurements-data");
  const measurements = new Measurements(grid, index);
  const viewer = new Viewer(document.getElementById("viewer"), measurements);
  const table = new GridTable(shortImages(grid), "Measurements", (at) => viewer.open(table, at));
  const changed = () => table.update();
  const find = (words) => {
    table.rows.search(words);
    changed();
  };
  const sheet = index.byImage.size > 0 ? new Sheet(table, measurements, (at) => viewer.open(table, at)) : null;
  const tools = element("div", { class: "tools" },
    searchField("Filter rows", "filter", find), ...choiceFields(table.grid, table.rows, changed).filter(Boolean),
    ...[selectedField(table.grid, table.rows, changed), sheet?.switch].filter(Boolean));
  table.update();
  place.replaceChildren(tools, table.count, table.scroll, ...(sheet ? [sheet.list] : []), table.pager);
}
