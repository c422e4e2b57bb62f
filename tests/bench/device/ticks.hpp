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

/// The work of the servo in a tick between the bytes of the device and those of the network, with
/// or without the additional work for a real device.
enum class Load : std::uint8_t {
    contact,  // the scene alone: the force is applied unchanged
    governed, // from encoder counts to a place, and through the governor with the joints' torques
};

/// Two peers that carry the cube to and fro between them, as in T3. The ticks of one side are
/// timed.
class Ticks {
public:
    explicit Ticks(Load load);
    ~Ticks();

    /// A reading of a clock, in nanoseconds.
    using Clock = std::function<std::int64_t()>;
    /// Plays this number of ticks, and appends the nanoseconds of each.
    void play(int ticks, const Clock& clock, std::vector<double>& nanoseconds);

    /// The last force felt. Using it keeps the compiler from removing the work.
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
