// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/document.hpp"
#include "proto/base/result.hpp"

#include <string_view>

namespace hapnet::lab::experiment {

/// Merges the entries of the table `over` into the table `under`. Tables are merged; every other
/// value replaces the old one.
void overlay(base::Node& under, const base::Node& over);

/// Removes the entry of this key from a table and returns it; an empty table when there is none.
[[nodiscard]] base::Node taken(base::Node& table, std::string_view key);

/// Returns "limit.delay.to=200ms" as a table for overlay(). A value that is not TOML is taken as a
/// text, so quotes can be left out. The error says how to write it.
[[nodiscard]] base::Result<base::Node> setting_table(std::string_view setting);

} // namespace hapnet::lab::experiment
