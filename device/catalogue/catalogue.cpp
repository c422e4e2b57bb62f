// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/catalogue/catalogue.hpp"

#include "device/dhd/transport/dhds.hpp"
#include "device/falcon/transport/falcons.hpp"
#include "device/hdapi/transport/hdapis.hpp"
#include "device/hid/transport/hids.hpp"
#include "device/inverse3/transport/inverse3s.hpp"
#include "device/omni1394/transport/omni1394s.hpp"

#include <algorithm>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

hid::Options hid_options(const DeviceOptions& options)
{
    return {.force_full_n = options.hid_force_n, .reach_m = 0.5 * options.hid_travel_m};
}

} // namespace

const std::vector<Backend>& backends()
{
    static const std::vector<Backend> all{
        {"omni1394", "PHANToM Omni with FireWire",
         [](const DeviceOptions&) { return omni1394::find_omnis(); },
         [](const std::string& serial, const DeviceOptions& options) {
             return omni1394::open_omni(serial, {.profile = options.omni_torque,
                                                 .uncalibrated_force = options.uncalibrated_force});
         }},
        {"hdapi", "Touch, Omni and Premium through their vendor's libHD",
         [](const DeviceOptions& options) { return hdapi::find_hdapis(options.hd_library); },
         [](const std::string& name, const DeviceOptions& options) {
             return hdapi::open_hdapi(name, options.hd_library);
         }},
        {"dhd", "omega, delta, sigma and lambda of Force Dimension through their vendor's libdhd",
         [](const DeviceOptions& options) { return dhd::find_dhds(options.dhd_library); },
         [](const std::string& serial, const DeviceOptions& options) {
             return dhd::open_dhd(serial, options.dhd_library);
         }},
        {"inverse3", "Haply Inverse3 through its vendor's local service",
         [](const DeviceOptions& options) {
             return inverse3::find_inverse3s(options.inverse3_port);
         },
         [](const std::string& id, const DeviceOptions& options) {
             return inverse3::open_inverse3(id, options.inverse3_port);
         }},
        {"falcon", "Novint Falcon", [](const DeviceOptions&) { return falcon::find_falcons(); },
         [](const std::string& serial, const DeviceOptions& options) {
             return falcon::open_falcon(serial, options.falcon_firmware);
         }},
        {"hid", "USB force feedback and the SpaceMouse",
         [](const DeviceOptions& options) { return hid::find_hids(hid_options(options)); },
         [](const std::string& serial, const DeviceOptions& options) {
             return hid::open_hid(serial, hid_options(options));
         }},
    };
    return all;
}

namespace {

const Backend* backend_named(std::string_view name)
{
    const auto found = std::find_if(backends().begin(), backends().end(),
                                    [&](const Backend& one) { return one.name == name; });
    return found == backends().end() ? nullptr : &*found;
}

/// Returns a hint for names by which people know a device; "" for others.
std::string_view hint_for(std::string_view name)
{
    if (name == "touch") {
        return "a Touch is opened through its vendor's library: use --device hdapi[:NAME]";
    }
    if (name == "omega" || name == "delta" || name == "sigma" || name == "lambda") {
        return "a device of Force Dimension is opened through its vendor's library: use --device "
               "dhd[:SERIAL]";
    }
    if (name == "haply") return "use --device inverse3[:ID] for a Haply Inverse3";
    if (name == "omni" || name == "phantom") {
        return "use --device omni1394 for a PHANToM Omni with FireWire, and --device hdapi[:NAME] "
               "for any other through its vendor's library";
    }
    return "";
}

} // namespace

base::Result<DeviceName> parse_device_name(std::string_view text)
{
    const auto colon = text.find(':');
    DeviceName name{std::string{text.substr(0, colon)}, ""};
    if (colon != std::string_view::npos) name.serial = text.substr(colon + 1);
    const bool is_cut_off = colon != std::string_view::npos && name.serial.empty();
    if (backend_named(name.backend) != nullptr && !is_cut_off) return name;
    const std::string_view hint = hint_for(name.backend);
    if (!hint.empty()) return base::fail(fmt::format("unknown device '{}': {}", text, hint));
    std::string known;
    for (const Backend& backend : backends()) {
        known += fmt::format(", {}[:SERIAL] ({})", backend.name, backend.what);
    }
    return base::fail(
        fmt::format("unknown device '{}': use one of sim, sim:joints, replay:FILE, page{}; "
                    "hapnet-peer list-devices shows which are connected",
                    text, known));
}

std::vector<Found> find_devices(const DeviceOptions& options)
{
    std::vector<Found> all;
    for (const Backend& backend : backends()) {
        auto some = backend.find(options);
        all.insert(all.end(), std::make_move_iterator(some.begin()),
                   std::make_move_iterator(some.end()));
    }
    return all;
}

Opened<std::unique_ptr<Device>> open_device(const std::string& name, const DeviceOptions& options)
{
    const auto parsed = parse_device_name(name);
    if (!parsed) return device_error(Fault::not_found, parsed.error().message);
    return backend_named(parsed->backend)->open(parsed->serial, options);
}

} // namespace hapnet::device
