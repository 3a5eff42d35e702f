// Order and choice of rows, of whatever they are made: a table in the document or rows of JSON.

/** Rows that can be sorted and filtered. `key(row, column)` is a number, a text or null; `text(row)` what is searched. */
class Rows {
  constructor(rows, key, text) {
    this.all = rows;
    this.key = key;
    this.text = text;
    this.column = null;
    this.descending = false;
    this.words = [];
    this.tests = new Map();
    this.texts = null;
  }

  /** First upwards, then downwards, then as it was. */
  sortBy(column) {
    if (this.column !== column) [this.column, this.descending] = [column, false];
    else if (!this.descending) this.descending = true;
    else [this.column, this.descending] = [null, false];
  }

  /** Words that a row must all hold. */
  search(words) {
    this.words = words.toLowerCase().split(/\s+/).filter(Boolean);
  }

  /** A test that rows must pass, or none. */
  test(name, passes) {
    if (passes) this.tests.set(name, passes);
    else this.tests.delete(name);
  }

  /** Places of the rows that are left, in order. */
  places() {
    let places = this.all.map((_, place) => place);
    for (const passes of this.tests.values()) places = places.filter((place) => passes(this.all[place]));
    if (this.words.length > 0) {
      this.texts ??= this.all.map((row) => this.text(row).toLowerCase());
      places = places.filter((place) => this.words.every((word) => this.texts[place].includes(word)));
    }
    return this.column === null ? places : this.sorted(places);
  }

  /** Empty cells come last in both directions; equal ones stay as they were. */
  sorted(places) {
    const keys = new Map(places.map((place) => [place, this.key(this.all[place], this.column)]));
    const sign = this.descending ? -1 : 1;
    const compare = (a, b) => (typeof a === "number" && typeof b === "number" ? a - b : byWords.compare(a, b));
    return places.sort((one, other) => {
      const [a, b] = [keys.get(one), keys.get(other)];
      if (a === null || b === null) return (a === null) - (b === null) || one - other;
      return sign * compare(a, b) || one - other;
    });
  }
}

/** The number that a text begins with, or null. */
function numberIn(text) {
  const number = Number.parseFloat(text.replace("\u2212", "-"));
  return Number.isNaN(number) ? null : number;
}
