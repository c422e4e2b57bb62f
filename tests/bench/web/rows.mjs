// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT

const numberOrNull = (value) => (Number.isFinite(value) ? value : null);

/**
 * A row as tests/bench/common/rows.cpp writes it, of a measure without a baseline. Where there is
 * a target it is an upper bound, which nothing keeps that could not be measured.
 */
export const rowOf = ({ case: name, subject, metric, unit, value, target }) => ({
  case: name,
  subject,
  baseline: null,
  metric: `${metric}, ${unit}`,
  value: numberOrNull(value),
  baseline_value: null,
  ratio: null,
  target: numberOrNull(target),
  direction: "max",
  met: Number.isFinite(target) ? value <= target : null,
});
