// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/packet.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace hapnet::emulator {

/// Gives each datagram of one direction the fate that the datagram of the same number had in a
/// recorded run, instead of drawing it. Datagrams after the last recorded one are dropped.
class Replay {
public:
    /// `fates` is not null.
    explicit Replay(std::shared_ptr<const std::vector<Fate>> fates) : fates_{std::move(fates)} {}

    [[nodiscard]] Fate on_packet(const Packet& packet) const
    {
        if (packet.number >= fates_->size()) return {.drop = DropCause::replay_ended};
        return (*fates_)[packet.number];
    }

private:
    std::shared_ptr<const std::vector<Fate>> fates_;
};

} // namespace hapnet::emulator
