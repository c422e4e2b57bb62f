// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/record/rows.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::lab::records {

/// What the analysis needs of a recorded state message.
struct MessageView {
    std::uint32_t session = 0;
    std::uint32_t sequence = 0;
    /// On the sender's clock.
    base::TimePoint sent{};
};

/// nullopt when the bytes are no state message, or one whose stamp no clock reads.
[[nodiscard]] std::optional<MessageView> view_of(const record::MessageRow& row);

} // namespace hapnet::lab::records
