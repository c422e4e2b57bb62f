// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Recorded sessions: what was played, how reliable it is, and how to repeat it.

import {
  figures, heading, notValid, panels, paragraph, table, textTable, words, zoomed,
} from "./words.js";

/** Whether to trust a session, in a sentence. */
const trust = ({ valid }) => (valid
  ? "Valid: both loops kept their time, and both sides were in session together."
  : "Not valid, for the reasons that stand with its figures.");

const isOfShares = (id) => /-(delays|lateness)$/.test(id);
const isOfPath = (id) => /-(delay|loss)$/.test(id);

/** The figures of a session: those over time zoom together. */
const sessionFigures = (ids, { network: asked, clock }) => {
  const [shares, paths] = [isOfShares, isOfPath].map((is) => ids.filter(is));
  const rest = ids.filter((id) => !isOfShares(id) && !isOfPath(id));
  const network = [heading("What the network did"), paragraph(asked), ...figures(paths),
    paragraph(clock)];
  return [zoomed([...figures(rest), ...(paths.length > 0 ? network : [])]),
    ...(shares.length > 0 ? [panels("", figures(shares))] : [])];
};

export const sessions = ({ groups }, data) => groups.flatMap((group, i) => {
  const session = data.sessions[i];
  const { played, valid, invalid_because: reasons, tables } = session;
  return [...(groups.length > 1 ? [heading(group.title), paragraph(`${played} ${trust(session)}`)]
    : []),
  ...(valid ? [] : [notValid(reasons)]), ...sessionFigures(group.figures, session),
  ...(i === 0 ? [paragraph("Times count from the start of the session on A’s clock. Each session "
    + "ends with hands off: then the two copies of each body should agree again.")] : []),
  panels("", tables.flatMap(textTable))];
});

export const repeat = (section, data) => data.sessions.flatMap(({ peers, repeats, settings }) => [
  ...(data.sessions.length > 1 ? [heading(`Peers ${peers[0]} (A) and ${peers[1]} (B)`)] : []),
  ...repeats.flatMap(({ what, commands }) => [paragraph(what),
    ...(commands.length > 0 ? [{ pre: commands.join("\n") }] : [])]),
  ...settings.flatMap(({ caption, unit, heads, rows, remarks }) => [
    table(caption, [unit, ...heads], rows.map(({ name, cells }) => [name, ...cells.map(words)])),
    ...remarks.map(paragraph)]),
]);

/** What was played, and whether it counts. */
export const leadOfSessions = (recorded) => {
  const [one] = recorded;
  if (recorded.length === 1) return `${one.played} ${trust(one)}`;
  const valid = recorded.filter((session) => session.valid).length;
  return `${recorded.length} pairs of records, ${valid} of them valid: what each side did, how far `
    + "the copies were apart, and what the network did.";
};
