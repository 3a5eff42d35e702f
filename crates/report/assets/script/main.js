// Starts what the page has.

startTheme();
for (const table of document.querySelectorAll("table.data")) {
  if (table.dataset.rows) startLongTable(table);
  else startStaticTable(table);
}
startMeasurements(document.getElementById("measurements-table"));
startSections();
