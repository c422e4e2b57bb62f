// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/flow/classifier.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::emulator {

class EmulatedPath;

/// The flows of a path between two ends: the classifier that assigns each packet to a flow, and the
/// path of each flow.
class Branches {
public:
    /// The paths must outlive this object.
    Branches(std::shared_ptr<const FlowFilters> filters, std::vector<EmulatedPath*> paths)
        : classifier_{std::move(filters)}, paths_{std::move(paths)}
    {}

    /// Returns the paths of the flows, in the order of the profile.
    [[nodiscard]] std::span<EmulatedPath* const> paths() const { return paths_; }

    /// Returns the flow that a packet belongs to; nullopt: it belongs to none, or its headers are
    /// not understood.
    [[nodiscard]] std::optional<std::size_t> flow_of(const std::optional<PacketFacts>& facts,
                                                     base::TimePoint arrival)
    {
        return facts ? classifier_.classify(*facts, arrival) : std::nullopt;
    }

    /// Returns the later one of `arrival` and the latest earlier result for this direction: flows
    /// that share a bottleneck need one order of arrival.
    [[nodiscard]] base::TimePoint in_order(Direction direction, base::TimePoint arrival)
    {
        auto& latest = latest_[static_cast<std::size_t>(direction)];
        return latest = std::max(latest, arrival);
    }

    /// See Classifier.
    [[nodiscard]] std::uint64_t unknown_fragments() const
    {
        return classifier_.unknown_fragments();
    }

private:
    Classifier classifier_;
    std::vector<EmulatedPath*> paths_;
    std::array<base::TimePoint, 2> latest_{base::TimePoint::min(), base::TimePoint::min()};
};

} // namespace hapnet::emulator
