// Poles that are chosen by clicks, and the command that names them.

const alike = 2e-3; // relative distance of frequencies below which a click takes a choice back

/** The choice with a frequency more, or without the one that lies there. By rising frequency. */
export function toggled(chosen, hz) {
  const rest = chosen.filter((f) => Math.abs(f / hz - 1) >= alike);
  return rest.length < chosen.length ? rest : [...chosen, hz].sort((a, b) => a - b);
}

/** The words of a command as a shell reads them, with the chosen poles at their end. */
export function commandOf(words, chosen) {
  const poles = chosen.map((hz) => `${Number(hz.toPrecision(6))} Hz`).join(', ');
  return [...words, ...(chosen.length ? ['--poles', poles] : [])].map(quoted).join(' ');
}

const quoted = (word) => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`);
