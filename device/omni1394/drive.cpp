// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/drive.hpp"

#include "device/omni1394/packet.hpp"
#include "proto/base/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device::omni1394 {

namespace {

constexpr std::array<std::string_view, 3> joint_names{"waist", "shoulder", "forearm"};
// The estimated peak torque at full count; its sign is unknown.
constexpr glm::dvec3 estimated_nm_per_count{omni::torque_max_nm.x / motor_max,
                                            omni::torque_max_nm.y / motor_max,
                                            omni::torque_max_nm.z / motor_max};
constexpr double uncalibrated_share = 0.25;
// The permitted range. Full scale is then between 2 mN m and 4 N m, which is a factor of a hundred
// below and of ten above the estimate.
constexpr double least_nm_per_count = 1e-6;
constexpr double most_nm_per_count = 2e-3;
constexpr double inkwell_angle_max = 1.0;

/// Reads the three numbers of a table, with `read(node, joint)`.
template <typename Read>
void read_joints(const base::Node& node, base::Reading& reading, Read read)
{
    const auto* entries = std::get_if<base::Node::Table>(&node.value);
    if (entries == nullptr) return base::complain_of(node, "a table", reading);
    base::TableReader table{*entries, node.place, reading};
    for (int joint = 0; joint < 3; ++joint) {
        const base::Node* value = table.require(joint_names[static_cast<std::size_t>(joint)]);
        if (value != nullptr) read(*value, joint);
    }
    table.finish();
}

glm::dvec3 read_torque(const base::Node& node, base::Reading& reading)
{
    glm::dvec3 torque{0.0};
    read_joints(node, reading, [&](const base::Node& value, int joint) {
        base::read_value(value, torque[joint], reading);
        const double size = std::abs(torque[joint]);
        if (size >= least_nm_per_count && size <= most_nm_per_count) return;
        reading.complain(value.place,
                         fmt::format("{}: {} is not a torque: give the measured one, {:g} to {:g} "
                                     "N m per count, with its sign",
                                     joint_names[static_cast<std::size_t>(joint)],
                                     base::what_it_is(value), least_nm_per_count,
                                     most_nm_per_count));
    });
    return torque;
}

omni::Joints read_inkwell(const base::Node& node, base::Reading& reading)
{
    omni::Joints joints;
    read_joints(node, reading, [&](const base::Node& value, int joint) {
        base::read_quantity(
            value, joints.angles[joint],
            [](std::string_view text) { return base::parse_quantity(text, base::angle_kind); },
            reading);
        if (std::abs(joints.angles[joint]) <= inkwell_angle_max) return;
        reading.complain(value.place, fmt::format("{} is out of range: use -{}rad to {}rad",
                                                  base::what_it_is(value), inkwell_angle_max,
                                                  inkwell_angle_max));
    });
    return joints;
}

void read_switch(const base::Node& node, bool& target, base::Reading& reading)
{
    const bool* value = std::get_if<bool>(&node.value);
    if (value == nullptr) return base::complain_of(node, "true or false", reading);
    target = *value;
}

} // namespace

base::Result<Profile> parse_profile(std::string_view text, const std::string& source)
{
    base::Reading reading{source};
    Profile profile;
    const auto document = base::parse_document(text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    base::TableReader table{std::get<base::Node::Table>(document->value), document->place, reading};
    if (const base::Node* node = table.find("write_register_20010")) {
        read_switch(*node, profile.writes_dubious_register, reading);
    }
    if (const base::Node* node = table.find("torque_nm_per_count")) {
        profile.torque_nm_per_count = read_torque(*node, reading);
    }
    if (const base::Node* node = table.find("inkwell")) {
        profile.inkwell = read_inkwell(*node, reading);
    }
    table.finish();
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return profile;
}

Use use_of(const Profile& profile, bool uncalibrated_force)
{
    if (profile.torque_nm_per_count) return Use::measured;
    return uncalibrated_force ? Use::uncalibrated : Use::read_only;
}

Drive::Drive(Use use, const Profile& profile)
    : use_{use},
      nm_per_count_{profile.torque_nm_per_count.value_or(estimated_nm_per_count)},
      word_max_{motor_max}
{
    if (use == Use::uncalibrated) word_max_ = static_cast<int>(uncalibrated_share * motor_max);
    if (use == Use::read_only) word_max_ = 0;
}

glm::ivec3 Drive::motor_words(const glm::dvec3& torque) const
{
    const glm::dvec3 exact = torque / nm_per_count_;
    if (!base::is_finite(exact)) return glm::ivec3{0};
    const double largest = std::max({std::abs(exact.x), std::abs(exact.y), std::abs(exact.z)});
    const double share = largest > word_max_ ? word_max_ / largest : 1.0;
    glm::ivec3 words{0};
    for (const int joint : {0, 1, 2}) {
        words[joint] = static_cast<int>(std::lround(share * exact[joint]));
    }
    return words;
}

glm::dvec3 Drive::torque_max_nm() const
{
    return {word_max_ * std::abs(nm_per_count_.x), word_max_ * std::abs(nm_per_count_.y),
            word_max_ * std::abs(nm_per_count_.z)};
}

void Drive::describe(Capabilities& capabilities) const
{
    const double share = static_cast<double>(word_max_) / motor_max;
    capabilities.force_max_n = share * omni::force_max_n;
    capabilities.force_continuous_n = std::min(omni::force_continuous_n, capabilities.force_max_n);
    capabilities.force_is_calibrated = use_ == Use::measured;
    if (use_ == Use::read_only) {
        capabilities.axes_out = 0;
        return;
    }
    capabilities.stiffness_max_n_per_m = omni::stiffness_max_n_per_m;
    capabilities.damping_max_ns_per_m = omni::damping_max_ns_per_m;
    capabilities.joints = JointLimits{omni::mechanism, torque_max_nm()};
}

} // namespace hapnet::device::omni1394
