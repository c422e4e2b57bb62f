// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/packet.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace hapnet::emulator {

/// Gives the datagrams of one direction the fates of a run that was recorded, number by number,
/// instead of drawing them. Datagrams after the last of them are dropped.
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
