// The sign of a cut that was made: what the prediction is worth.

export const isWrong = (cut) => cut.right === false;

/** A cut that would count, and whose prediction has no answer that holds; a marginal one counts neither way. */
export const isDoubtful = (cut) => cut.observed !== 'marginal' && (cut.right === null || cut.right === undefined);

/** The symbol of its outcome: open where the prediction is wrong, with a dot where it is doubtful. */
export const symbolOf = (cut, symbol) => (isWrong(cut) ? `${symbol}-open` : isDoubtful(cut) ? `${symbol}-open-dot` : symbol);
