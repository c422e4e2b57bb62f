// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/setting.hpp"
#include "proto/base/result.hpp"
#include "proto/record/codec.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace hapnet::lab::records {

/// The record of a session in the form that a daemon writes it: the head of its file, and its rows
/// in the order in which they were written.
struct KeptRecord {
    nlohmann::json config;
    record::Layout layout{};
    std::vector<record::Row> rows;
};

/// Plays a session in virtual time to the end of its hands-off tail, and keeps a record of each
/// player as hapnet-peer does. The programs analyse, export and replay accept it. A pure function
/// of the setting. Fails when no session can be played with this setting, when its messages are
/// sealed, or when it never began.
[[nodiscard]] base::Result<std::vector<KeptRecord>>
play_and_keep(const virtual_time::Setting& setting);

} // namespace hapnet::lab::records
