// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/stream_statistics.hpp"
#include "emulator/tools/batch_means.hpp"
#include "proto/base/figures/tally.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::emulator::tools {

/// A stream of equal datagrams at even distances, equal in both directions.
struct Stream {
    base::Duration spacing = std::chrono::milliseconds{1}; // > 0
    std::uint64_t packets = 400'000;
    std::size_t bytes = 136; // payload, at most 65507; as a state in the paper's scene
    // The path of the stream, if there are several. It is also in the names of its draws.
    std::string path{};
    bool is_sealed = false; // damaged datagrams count as lost: the receiver refuses them

    friend bool operator==(const Stream&, const Stream&) = default;
};

/// The outcome of the stream in one direction.
struct DirectionPrediction {
    Statistics statistics; // counted until nothing is in flight
    StreamReport measured;
    /// Runs of losses, by sequence number: datagrams that were dropped, or damaged ones if they
    /// count as lost.
    base::Tally loss_runs;
    base::Duration added_by_queues{}; // mean delay that rate and order add to the drawn one
    /// The precision of the delay's mean and deviation; nullopt: too few datagrams left the link.
    std::optional<Precision> precision;

    /// True if both are known to within settled_to, or if no delay was measured.
    [[nodiscard]] bool is_settled() const;
    [[nodiscard]] double loss_share() const;
};

struct Prediction {
    DirectionPrediction up;
    DirectionPrediction down;

    [[nodiscard]] bool is_settled() const { return up.is_settled() && down.is_settled(); }
};

/// Mean and deviation have settled when they are known to within this share.
inline constexpr double settled_to = 0.01;

/// Sends a stream through a profile, in virtual time, by the code that real datagrams pass. Nothing
/// is late in virtual time, so the result shows the effects of the profile alone.
[[nodiscard]] Prediction predict(const Profile& profile, const Stream& stream, base::Seed seed);

/// Like predict(), but the stream grows. It begins with stream.packets and doubles up to
/// `packets_max`, until mean and deviation of the delay have settled in both directions. Conditions
/// that change on a timeline never settle; the stream then has stream.packets.
[[nodiscard]] Prediction predict_until_settled(const Profile& profile, const Stream& stream,
                                               base::Seed seed, std::uint64_t packets_max);

} // namespace hapnet::emulator::tools
