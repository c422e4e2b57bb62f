// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/probe_message.hpp"
#include "proto/base/recent_numbers.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// Answers the questions of a probe, and counts them, so that the asking side can distinguish a
/// lost question from a lost answer. It remembers the most recent sessions. Does no I/O.
class ProbeAnswerer {
public:
    explicit ProbeAnswerer(std::uint64_t boot) : boot_{boot} {}

    /// Returns the answer to a question that arrived at `received`; nullopt for an answer, so that
    /// two answerers cannot answer each other. Set `answered` when the answer leaves.
    [[nodiscard]] std::optional<ProbeMessage> answer(const ProbeMessage& question,
                                                     base::TimePoint received);

    static constexpr std::size_t sessions_max = 64;

private:
    struct Session {
        std::uint64_t id = 0;
        base::RecentNumbers<1024> questions{};
        std::uint64_t heard = 0;
        base::TimePoint last{};
    };

    [[nodiscard]] Session& session_of(std::uint64_t id);

    std::uint64_t boot_;
    std::vector<Session> sessions_;
};

} // namespace hapnet::emulator::tools
