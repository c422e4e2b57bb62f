// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/recognise.hpp"

#include "device/hid/spacemouse_report.hpp"
#include "device/hid/usages.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device::hid {

namespace {

bool has_collection(const Descriptor& descriptor, Usage usage)
{
    const auto& all = descriptor.collections;
    return std::find(all.begin(), all.end(), usage) != all.end();
}

void add_layouts(RecognisedDevice& seen, const Descriptor& descriptor)
{
    auto input = find_input(descriptor);
    if (!input) {
        seen.unusable = DeviceError{
            Fault::communication,
            fmt::format("its report descriptor is of no use here: {}", input.error().message)};
        return;
    }
    seen.input = *std::move(input);
    auto force = find_force(descriptor);
    if (force) {
        seen.force = *std::move(force);
    } else {
        seen.no_force_because = force.error().message;
    }
}

} // namespace

std::optional<RecognisedDevice> recognise(const HidNode& shown)
{
    if (!shown.descriptor) return std::nullopt;
    const auto descriptor = parse_descriptor(*shown.descriptor);
    // A device without a valid descriptor is not supported.
    if (!descriptor) return std::nullopt;
    RecognisedDevice seen{.path = shown.path,
                          .node = shown.path.substr(shown.path.rfind('/') + 1),
                          .serial = shown.serial,
                          .name = shown.name};
    if (seen.serial.empty()) seen.serial = seen.node;
    const std::string_view spacemouse = spacemouse_name(shown.vendor, shown.product);
    // Its receivers also have other nodes, which act as keyboards.
    if (!spacemouse.empty() && has_collection(*descriptor, usage::multi_axis_controller)) {
        seen.is_spacemouse = true;
        seen.name = spacemouse;
        return seen;
    }
    if (!is_force_device(*descriptor)) return std::nullopt;
    if (seen.name.empty()) seen.name = fmt::format("{:04x}:{:04x}", shown.vendor, shown.product);
    add_layouts(seen, *descriptor);
    return seen;
}

Identity identity_of(const RecognisedDevice& seen, const Options& options)
{
    Identity identity{.backend = "hid",
                      .serial = seen.serial,
                      .model = seen.name,
                      .note = std::string{never_run}};
    if (seen.is_spacemouse) {
        identity.model += " (SpaceMouse, input only)";
        return identity;
    }
    identity.model += " (USB HID PID)";
    if (seen.unusable) return identity;
    if (!seen.force) {
        identity.note += fmt::format("; no force: {}", seen.no_force_because);
    } else if (!options.force_full_n) {
        identity.note += "; no force until --hid-force says what full scale is at the grip";
    }
    return identity;
}

} // namespace hapnet::device::hid
