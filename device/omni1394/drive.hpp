// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/omni/geometry.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::device::omni1394 {

/// Measurements of one device, from a TOML file. Every part may be missing:
///
///     write_register_20010 = false     # two Omnis on one bus may need that; default true
///     [torque_nm_per_count]            # measured at the joint; the sign is the direction
///     waist    = 2.7e-4
///     shoulder = -2.1e-4
///     forearm  = 2.1e-4
///     [inkwell]                        # the joints' angles with the stylus in its inkwell
///     waist    = "0rad"
///     shoulder = "0.23rad"
///     forearm  = "-0.37rad"
///
/// All three numbers of a table are required where it is there.
struct Profile {
    bool writes_dubious_register = true;
    std::optional<glm::dvec3> torque_nm_per_count{};
    omni::Joints inkwell = omni::inkwell_pose;
};

/// Reads a profile. Errors begin with FILE:LINE:COLUMN and say what is possible there.
[[nodiscard]] base::Result<Profile> parse_profile(std::string_view text, const std::string& source);

/// The permitted use of a device's motors.
enum class Use : std::uint8_t {
    read_only,    // the default: the torque per count was not measured
    uncalibrated, // at most a quarter of the counts, at an estimated scale
    measured,     // all counts, at the measured scale
};
[[nodiscard]] Use use_of(const Profile& profile, bool uncalibrated_force);

/// Converts torques at the joints to motor words.
class Drive {
public:
    Drive(Use use, const Profile& profile);

    /// Returns the motor words for a torque, N m. If one is too large, all are scaled down
    /// together, so that the direction stays. Zero for a torque that is not finite.
    [[nodiscard]] glm::ivec3 motor_words(const glm::dvec3& torque) const;

    [[nodiscard]] Use use() const { return use_; }
    /// Returns the torque of the motors at the largest word that may be sent.
    [[nodiscard]] glm::dvec3 torque_max_nm() const;
    /// Sets the device's limits on force. All other abilities are those of the Omni.
    void describe(Capabilities& capabilities) const;

private:
    Use use_;
    glm::dvec3 nm_per_count_;
    int word_max_;
};

} // namespace hapnet::device::omni1394
