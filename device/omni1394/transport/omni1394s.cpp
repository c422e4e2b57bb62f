// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/transport/omni1394s.hpp"

#include "device/omni1394/omni.hpp"
#include "device/omni1394/registers.hpp"
#include "device/omni1394/transport/firewire_link.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <system_error>

namespace hapnet::device::omni1394 {

namespace {

constexpr const char* bus_folder = "/sys/bus/firewire/devices";

std::string first_line_of(const std::filesystem::path& file)
{
    std::ifstream in{file};
    std::string line;
    std::getline(in, line);
    return line;
}

/// An Omni on a bus: its node, and the serial of its bus interface.
struct BusNode {
    std::string node;
    std::string guid;
};

std::vector<BusNode> look_around()
{
    std::vector<BusNode> seen;
    std::error_code error;
    // Units, such as fw1.0, have no vendor of their own.
    for (const auto& entry : std::filesystem::directory_iterator{bus_folder, error}) {
        if (first_line_of(entry.path() / "vendor") != fmt::format("{:#08x}", vendor_id)) continue;
        seen.push_back(
            {"/dev/" + entry.path().filename().string(), first_line_of(entry.path() / "guid")});
    }
    std::sort(seen.begin(), seen.end(),
              [](const BusNode& a, const BusNode& b) { return a.node < b.node; });
    return seen;
}

Found found(const BusNode& seen)
{
    Found omni{{.backend = "omni1394",
                .serial = seen.guid,
                .model = "PHANToM Omni (FireWire)",
                .note = std::string{never_run}}};
    const auto link = FirewireLink::open(seen.node);
    if (!link) {
        omni.unusable = link.error();
        return omni;
    }
    std::array<std::byte, 4> quadlet{};
    const auto read = (*link)->read_register(serial_register, quadlet);
    if (read && *read == quadlet.size()) {
        omni.identity.serial = serial_of(quadlet_of(quadlet));
    } else {
        omni.unusable = read ? DeviceError{Fault::communication,
                                           "it does not say its serial number: unplug it, "
                                           "plug it in again, and start again"}
                             : read.error();
    }
    return omni;
}

Opened<Profile> profile_in(const std::string& file)
{
    if (file.empty()) return Profile{};
    std::ifstream in{file};
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) return device_error(Fault::not_found, file + ": cannot be read");
    const auto profile = parse_profile(text.str(), file);
    if (!profile) return device_error(Fault::internal, profile.error().message);
    return *profile;
}

} // namespace

std::vector<Found> find_omnis()
{
    std::vector<Found> omnis;
    for (const BusNode& seen : look_around()) omnis.push_back(found(seen));
    return omnis;
}

Opened<std::unique_ptr<Device>> open_omni(const std::string& serial, const Options& options)
{
    const auto profile = profile_in(options.profile);
    if (!profile) return tl::unexpected{profile.error()};
    DeviceError why{Fault::not_found,
                    fmt::format("no FireWire Omni {}was found on a bus: {}",
                                serial.empty() ? "" : serial + " ", cure_of_not_found)};
    for (const BusNode& seen : look_around()) {
        const Found omni = found(seen);
        if (omni.unusable) {
            why = *omni.unusable; // its serial is unknown, so it may be the requested one
            continue;
        }
        if (!serial.empty() && serial != omni.identity.serial && serial != seen.guid) continue;
        auto link = FirewireLink::open(seen.node);
        if (!link) return tl::unexpected{link.error()};
        return Omni::open(*std::move(link), *profile, use_of(*profile, options.uncalibrated_force));
    }
    return tl::unexpected{why};
}

} // namespace hapnet::device::omni1394
