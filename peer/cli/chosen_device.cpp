// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/chosen_device.hpp"

#include "device/page/page_hand.hpp"
#include "device/replay/replay.hpp"
#include "device/simulated/joints/joint_omni.hpp"
#include "device/simulated/omni.hpp"
#include "proto/base/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

constexpr glm::dvec3 omni_span_m{0.160, 0.120, 0.070};

double default_scale(const device::Capabilities& capabilities)
{
    const base::Displacement span = capabilities.workspace_max - capabilities.workspace_min;
    double scale = 1.0;
    for (int axis = 0; axis < capabilities.axes_in; ++axis) {
        scale = std::max(scale, omni_span_m[axis] / span.value[axis]);
    }
    return scale;
}

base::Displacement default_offset(const device::Capabilities& capabilities, double scale)
{
    const glm::dvec3 centre =
        0.5 * (capabilities.workspace_min.value + capabilities.workspace_max.value);
    return {-scale * centre};
}

} // namespace

device::Opened<std::unique_ptr<device::Device>> open_chosen(const DeviceChoice& choice,
                                                            device::Task task)
{
    if (choice.replay) {
        return std::make_unique<device::Replay>(
            *choice.replay, choice.name,
            choice.replay_loops ? device::AfterTheEnd::begins_again : device::AfterTheEnd::stays);
    }
    if (choice.page) return std::make_unique<device::PageHand>(choice.page);
    if (choice.has_joints()) {
        return std::make_unique<device::JointOmni>(
            device::JointOmniSettings{.role = {.task = task, .person = choice.person}});
    }
    if (choice.is_simulated()) {
        return std::make_unique<device::SimulatedOmni>(
            device::Performer{.task = task, .person = choice.person});
    }
    return device::open_device(choice.name, choice.options);
}

std::string describe_open_error(const DeviceChoice& choice, const device::DeviceError& error)
{
    return fmt::format("--device {}: {}", choice.name, error.message);
}

std::optional<device_state::KeptDevice> kept_of(const DeviceChoice& choice,
                                                const device::Device& device)
{
    if (!choice.is_real() || device.capabilities().force_max_n <= 0.0) return std::nullopt;
    const std::size_t colon = choice.name.find(':');
    const std::string_view place = colon == std::string::npos
                                       ? std::string_view{}
                                       : std::string_view{choice.name}.substr(colon + 1);
    return device_state::KeptDevice{device.identity(), place};
}

device::Mount mount_of(const DeviceChoice& choice, const device::Capabilities& capabilities)
{
    device::Mount mount;
    mount.scale = choice.mount_scale.value_or(choice.is_real() ? default_scale(capabilities) : 1.0);
    if (choice.is_real()) mount.offset = default_offset(capabilities, mount.scale);
    if (choice.mount_offset) mount.offset = *choice.mount_offset;
    return mount;
}

std::string note_on_stiffness(const device::Capabilities& capabilities, const device::Mount& mount,
                              double scene_stiffness_n_per_m)
{
    const double most = capabilities.stiffness_max_n_per_m;
    const double at_the_hand = scene_stiffness_n_per_m * mount.scale * mount.scale;
    if (capabilities.axes_out == 0 || most == 0.0 || at_the_hand <= most) return "";
    return fmt::format(
        "contacts of {:.0f} N/m in the scene, magnified {:.2f} times, are {:.0f} N/m at the hand, "
        "and this device is said to render at most {:.0f} N/m without buzzing: they are felt at "
        "no more than {:.0f} % of their force. To feel all of it: a --mount-scale of at most "
        "{:.2f}, or a --scene with softer contacts",
        scene_stiffness_n_per_m, mount.scale, at_the_hand, most, 100.0 * most / at_the_hand,
        std::floor(100.0 * std::sqrt(most / scene_stiffness_n_per_m)) / 100.0);
}

std::string note_on_force_limit(double asked_n, double allowed_n)
{
    if (asked_n <= allowed_n) return "";
    const auto text = [](double newtons) { return base::quantity_text(newtons, base::force_kind); };
    return fmt::format("--force-limit {}: the device allows at most {}, and that limit holds",
                       text(asked_n), text(allowed_n));
}

std::string_view parts_in(device::Task task)
{
    switch (task) {
    case device::Task::p1:
        return "A holds the cube by the primary button and carries it to and fro, B watches";
    case device::Task::t1: return "by turns A pushes the cube to the right and B pushes it back";
    case device::Task::t2: return "one holds the cube in place, the other presses against it";
    case device::Task::t3: return "both press the cube between them and carry it slowly to and fro";
    case device::Task::t7:
        return "all press the cube between them, from the left and from the right by turns of "
               "their ids, and carry it slowly to and fro";
    case device::Task::t4: return "both press the cube between them, lift it, hold it, lower it";
    case device::Task::t5:
        return "both press the cube to the right against the static one; by turns one lets go";
    case device::Task::t6: return "A taps the cube, B rests a hand on its far side";
    case device::Task::t8:
        return "all turn the cube between them to and fro, each pushing beside its middle, "
               "from the left and from the right by turns of their ids";
    case device::Task::t9:
        return "by the primary button A takes the left cube and puts it on the middle one, then B "
               "the right one on both; further hands watch";
    case device::Task::t10:
        return "by the primary button A lifts the screwdriver and holds it out, B takes it and "
               "puts it down on the right; further hands watch";
    }
    return "";
}

std::string introduction(const device::Device& device, const device::Mount& mount,
                         device::Task task)
{
    const auto millimetres = [&](int axis) {
        return std::round(1e3 * mount.offset.value[axis]) + 0.0; // + 0.0 avoids -0
    };
    return fmt::format(
        "{}; mounted at {:.0f},{:.0f},{:.0f} mm, magnified {:.2f} times (--mount-offset, "
        "--mount-scale). Task {} is yours to play, the lower --id is A: {}",
        device::description(device), millimetres(0), millimetres(1), millimetres(2), mount.scale,
        device::name_of(task), parts_in(task));
}

} // namespace hapnet::peer
