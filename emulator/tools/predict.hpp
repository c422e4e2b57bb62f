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

/// A stream of equal datagrams at even distances, the same both ways.
struct Stream {
    base::Duration spacing = std::chrono::milliseconds{1}; // > 0
    std::uint64_t packets = 400'000;
    std::size_t bytes = 136; // payload, at most 65507; as a state in the paper's scene
    std::string path{};      // path that it takes, if there are several; names its draws
    bool is_sealed = false;  // damaged datagrams count as lost: the receiver refuses them

    friend bool operator==(const Stream&, const Stream&) = default;
};

/// The outcome of the stream in one direction.
struct DirectionPrediction {
    Statistics statistics; // counted until nothing is in flight
    StreamReport measured;
    /// Runs of losses by their numbers: dropped, or damaged where that is refused.
    base::Tally loss_runs;
    base::Duration added_by_queues{}; // mean delay that rate and order add to the drawn one
    /// The precision of the delay's mean and deviation; nullopt: too few datagrams left the link.
    std::optional<Precision> precision;

    /// True if both are known to settled_to, or there is no delay to be known.
    [[nodiscard]] bool is_settled() const;
    [[nodiscard]] double loss_share() const;
};

struct Prediction {
    DirectionPrediction up;
    DirectionPrediction down;

    [[nodiscard]] bool is_settled() const { return up.is_settled() && down.is_settled(); }
};

/// Mean and deviation have settled when they are known to this share.
inline constexpr double settled_to = 0.01;

/// Plays a profile to a stream, in virtual time, through the link that real datagrams take. Nothing
/// is late in virtual time: what it shows is what the profile itself does.
[[nodiscard]] Prediction predict(const Profile& profile, const Stream& stream, base::Seed seed);

/// Like predict(), but the stream grows. It begins with stream.packets and doubles up to
/// `packets_max`, until mean and deviation of the delay have settled in both directions. Conditions
/// that change on a timeline never settle: they get stream.packets.
[[nodiscard]] Prediction predict_until_settled(const Profile& profile, const Stream& stream,
                                               base::Seed seed, std::uint64_t packets_max);

} // namespace hapnet::emulator::tools
