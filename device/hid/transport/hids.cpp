// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/transport/hids.hpp"

#include "device/hid/pid_device.hpp"
#include "device/hid/pid_opening.hpp"
#include "device/hid/pid_sender.hpp"
#include "device/hid/recognise.hpp"
#include "device/hid/spacemouse.hpp"
#include "device/hid/transport/hidraw_wire.hpp"
#include "device/hid/transport/node.hpp"
#include "device/hid/transport/sender_thread.hpp"

#include <algorithm>
#include <hidapi.h>
#include <utility>

namespace hapnet::device::hid {

namespace {

/// Replaces each character that is not printable ASCII by '?'. Serial numbers consist of ASCII.
std::string narrow(const wchar_t* text)
{
    std::string narrowed;
    for (; text != nullptr && *text != L'\0'; ++text) {
        narrowed += *text >= L' ' && *text <= L'~' ? static_cast<char>(*text) : '?';
    }
    return narrowed;
}

/// Returns every node that is a recognised device.
std::vector<RecognisedDevice> look_around()
{
    const std::unique_ptr<hid_device_info, decltype(&hid_free_enumeration)> all{
        hid_enumerate(0, 0), &hid_free_enumeration};
    std::vector<RecognisedDevice> found;
    std::vector<std::string> paths; // hid_enumerate() lists a device once for each of its usages
    for (const hid_device_info* one = all.get(); one != nullptr; one = one->next) {
        const std::string path = one->path;
        if (std::find(paths.begin(), paths.end(), path) != paths.end()) continue;
        paths.push_back(path);
        auto seen = recognise({.path = path,
                               .vendor = one->vendor_id,
                               .product = one->product_id,
                               .serial = narrow(one->serial_number),
                               .name = narrow(one->product_string),
                               .descriptor = descriptor_of(path)});
        if (seen) found.push_back(*std::move(seen));
    }
    return found;
}

Opened<std::unique_ptr<Device>> open_spacemouse(const RecognisedDevice& seen, Claim claim)
{
    auto wire = HidrawWire::open(seen.path, std::move(claim));
    if (!wire) return tl::unexpected{wire.error()};
    return std::make_unique<SpaceMouse>(identity_of(seen, {}), *std::move(wire));
}

Opened<std::unique_ptr<Device>> open_pid(const RecognisedDevice& seen, const Options& options,
                                         Claim claim)
{
    PidParts parts{
        .identity = identity_of(seen, options), .input = *seen.input, .options = options};
    const bool has_force = options.force_full_n && seen.force;
    std::optional<Claim> for_reader{std::move(claim)};
    if (has_force) { // the sender holds the claim on the node until its end
        auto wire = HidrawWire::open(seen.path, std::exchange(for_reader, std::nullopt));
        if (!wire) return tl::unexpected{wire.error()};
        const auto prepared = prepare(**wire, *seen.force, seen.input->axes.size());
        if (!prepared) return tl::unexpected{prepared.error()};
        parts.outbox = std::make_unique<SenderThread>(*std::move(wire),
                                                      PidSender{*seen.force, prepared->blocks});
    }
    auto wire = HidrawWire::open(seen.path, std::move(for_reader));
    if (!wire) return tl::unexpected{wire.error()};
    parts.wire = *std::move(wire);
    return std::make_unique<PidDevice>(std::move(parts));
}

Opened<std::unique_ptr<Device>> open_seen(const RecognisedDevice& seen, const Options& options)
{
    if (seen.unusable) return tl::unexpected{*seen.unusable};
    auto claim = Claim::take(seen.path);
    if (!claim) return tl::unexpected{claim.error()};
    if (seen.is_spacemouse) return open_spacemouse(seen, *std::move(claim));
    return open_pid(seen, options, *std::move(claim));
}

} // namespace

std::vector<Found> find_hids(const Options& options)
{
    std::vector<Found> found;
    for (const RecognisedDevice& seen : look_around()) {
        Found one{identity_of(seen, options), seen.unusable};
        if (!one.unusable) {
            const auto claim = Claim::take(seen.path);
            if (!claim) one.unusable = claim.error();
        }
        found.push_back(std::move(one));
    }
    return found;
}

Opened<std::unique_ptr<Device>> open_hid(const std::string& serial, const Options& options)
{
    std::optional<DeviceError> first;
    for (const RecognisedDevice& seen : look_around()) {
        if (!serial.empty() && serial != seen.serial && serial != seen.node) continue;
        auto opened = open_seen(seen, options);
        if (opened) return opened;
        if (!first) first = opened.error();
    }
    if (first) return tl::unexpected{*first};
    return device_error(Fault::not_found,
                        serial.empty() ? "there is no force-feedback device (USB HID PID) and no "
                                         "SpaceMouse: check cable and power"
                                       : "there is no HID device " + serial +
                                             ": hapnet-peer list-devices shows those that are");
}

} // namespace hapnet::device::hid
