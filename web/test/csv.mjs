// The result folder's CSV files, read by another way than the program writes them.

/** Rows as objects by the names of the columns; what is a number becomes one. */
export function table(text) {
  const [head, ...rows] = text.split('\n').filter((line) => line && !line.startsWith('#')).map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(row.map((cell, i) => [head[i], cell === '' || Number.isNaN(Number(cell)) ? cell : Number(cell)])));
}
