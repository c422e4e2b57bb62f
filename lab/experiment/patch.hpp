// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/document.hpp"
#include "proto/base/result.hpp"

#include <string_view>

namespace hapnet::lab::experiment {

/// Puts the entries of `over` into the table `under`: tables into tables, all else instead of what
/// was there. Both are tables.
void overlay(base::Node& under, const base::Node& over);

/// Takes the entry of this key out of a table; an empty table when there is none.
[[nodiscard]] base::Node taken(base::Node& table, std::string_view key);

/// "limit.delay.to=200ms" as a table to overlay. A value that is no TOML is a text: quotes can be
/// left out. The error says how to write it.
[[nodiscard]] base::Result<base::Node> setting_table(std::string_view setting);

} // namespace hapnet::lab::experiment
