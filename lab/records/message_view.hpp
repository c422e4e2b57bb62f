// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/record/rows.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::lab::records {

/// The parts of a recorded state message that the analysis needs.
struct MessageView {
    std::uint32_t session = 0;
    std::uint32_t sequence = 0;
    /// The time of sending, on the sender's clock.
    base::TimePoint sent{};
};

/// Reads a message. Returns nullopt for bytes that are not a state message, or for one with an
/// impossible time stamp.
[[nodiscard]] std::optional<MessageView> view_of(const record::MessageRow& row);

} // namespace hapnet::lab::records
