// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/stream_statistics.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::emulator::tools {

/// A stream of equal datagrams at even distances, the same both ways.
struct Stream {
    base::Duration spacing = std::chrono::milliseconds{1}; // > 0
    std::uint64_t packets = 400'000;
    std::size_t bytes = 144; // of payload, at most 65507

    friend bool operator==(const Stream&, const Stream&) = default;
};

/// What became of the stream in one direction.
struct DirectionPrediction {
    Statistics statistics; // nothing in flight any more
    StreamReport measured;
    std::uint64_t lost = 0;           // dropped, whatever the cause
    std::uint64_t loss_runs = 0;      // of losses in a row, by their numbers
    std::uint64_t loss_run_max = 0;   // in datagrams
    base::Duration added_by_queues{}; // mean delay beyond the drawn one: rate and order

    [[nodiscard]] double loss_share() const;
    [[nodiscard]] std::optional<double> loss_run_mean() const;
};

struct Prediction {
    DirectionPrediction up;
    DirectionPrediction down;
};

/// Plays a profile to a stream, in virtual time, through the link that real datagrams take. Nothing
/// is late in virtual time: what it shows is what the profile itself does.
[[nodiscard]] Prediction predict(const Profile& profile, const Stream& stream, base::Seed seed);

} // namespace hapnet::emulator::tools
