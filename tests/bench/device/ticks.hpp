// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/side.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace hapnet::bench {

/// The servo's work in a tick between the device's bytes and the network's, with or without what
/// a real device adds to it.
enum class Load : std::uint8_t {
    contact,  // the scene alone: the force goes as it comes
    governed, // from encoder counts to a place, and through the governor with the joints' torques
};

/// Two peers that carry the cube to and fro between them, T3's way, and whose ticks are timed on
/// one side.
class Ticks {
public:
    explicit Ticks(Load load);
    ~Ticks();

    /// A reading of a clock, in nanoseconds.
    using Clock = std::function<std::int64_t()>;
    /// Plays this number of ticks; the nanoseconds that each took.
    void play(int ticks, const Clock& clock, std::vector<double>& nanoseconds);

    /// The force that was felt last: work that cannot be left out.
    [[nodiscard]] base::Force felt() const { return side_.told(); }
    [[nodiscard]] const device::Governor& governor() const { return rig_.governor(); }

private:
    void deliver();
    void tick();

    Load load_;
    base::TimePoint now_{std::chrono::hours{1}};
    peer::Side side_;
    peer::Peer other_;
    device::Rig rig_;
};

} // namespace hapnet::bench
