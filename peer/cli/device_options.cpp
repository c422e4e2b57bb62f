// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/device_options.hpp"

#include "device/omni1394/drive.hpp"
#include "proto/base/quantity.hpp"
#include "proto/net/text_file.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

constexpr double mount_scale_max = 20.0;
constexpr double mount_scale_min = 0.05;
constexpr double hid_force_max_n = 100.0;
// Its loader takes 14 000 bytes a second: more would load for longer than a minute.
constexpr std::size_t falcon_firmware_max_bytes = 1U << 20;
constexpr std::string_view replay_prefix = "replay:";
constexpr double hid_travel_min_m = 0.01;
constexpr double hid_travel_max_m = 5.0;

std::string device_help()
{
    std::string help =
        "sim: a simulated Omni in a simulated hand (what a session takes by itself); sim:joints:\n"
        "with its joints, encoders, motors and inkwell; replay:FILE: a hand that goes the way in\n"
        "FILE, CSV with time_s,x_m,y_m,z_m[,gripping] or as hapnet-lab export writes it";
    help += fmt::format(";\nor a real one, by serial or the first that is usable; {}:",
                        device::never_run);
    for (const device::Backend& backend : device::backends()) {
        help += fmt::format("\n  {:<9} {}", backend.name, backend.what);
    }
    return help + "\n(hapnet-peer list-devices shows those that are there; docs/use/hardware.md)";
}

/// What --help says of an option, and the form of its value.
struct Explanation {
    std::string help;
    const char* type;
};

template <typename Text>
void add_option(CLI::App& app, const char* name, Text& text, const Explanation& explanation)
{
    app.add_option(name, text, explanation.help)->type_name(explanation.type)->group("Device");
}

base::Result<device::HandTrace> hand_trace_in(const std::string& file)
{
    if (file.empty()) return base::fail("replay: needs a file, as in replay:hand.csv");
    const auto text = net::text_of_file(file);
    if (!text) return tl::unexpected{text.error()};
    return device::parse_hand_trace(*text, file);
}

/// "0mm,20mm,-5mm"
base::Result<base::Displacement> parse_offset(const std::string& text)
{
    const auto refuse = [&] {
        return base::fail(fmt::format("'{}' is no offset: three lengths such as 0mm,20mm,-5mm, "
                                      "each of at most 1m",
                                      text));
    };
    base::Displacement offset;
    std::string_view rest = text;
    for (const int axis : {0, 1, 2}) {
        const auto comma = rest.find(',');
        if ((comma == std::string_view::npos) != (axis == 2)) return refuse();
        const auto length = base::parse_quantity(rest.substr(0, comma), base::length_kind);
        if (!length || std::abs(*length) > 1.0) return refuse();
        offset.value[axis] = *length;
        rest.remove_prefix(axis == 2 ? rest.size() : comma + 1);
    }
    return offset;
}

base::Result<double> parse_scale(const std::string& text)
{
    double scale = 0.0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, scale);
    const bool is_number = error == std::errc{} && rest == end;
    if (is_number && scale >= mount_scale_min && scale <= mount_scale_max) return scale;
    return base::fail(fmt::format("'{}' is no scale: a number from {} to {}, such as 1.5", text,
                                  mount_scale_min, mount_scale_max));
}

/// The name of a file that holds a firmware, as far as can be told without its device.
base::Result<std::string> firmware_at(const std::string& file)
{
    const auto bytes = net::text_of_file(file);
    if (!bytes) return tl::unexpected{bytes.error()};
    if (bytes->empty()) return base::fail(fmt::format("{} is empty", file));
    if (bytes->size() <= falcon_firmware_max_bytes) return file;
    return base::fail(fmt::format("{} has {} bytes, and no firmware of a Falcon has more than {}",
                                  file, bytes->size(), falcon_firmware_max_bytes));
}

/// The name of a file that holds what an Omni's motors were measured to give.
base::Result<std::string> omni_profile_at(const std::string& file)
{
    const auto text = net::text_of_file(file);
    if (!text) return tl::unexpected{text.error()};
    const auto profile = device::omni1394::parse_profile(*text, file);
    if (!profile) return tl::unexpected{profile.error()};
    return file;
}

base::Result<std::string> library_named(const std::string& file)
{
    if (file.empty()) return base::fail("needs the vendor's library, as in /usr/lib/libHD.so");
    return file;
}

base::Result<double> parse_hid_force(const std::string& text)
{
    auto force = base::parse_quantity(text, base::force_kind);
    if (force && !(*force != 0.0 && std::abs(*force) <= hid_force_max_n)) {
        return base::fail(
            fmt::format("'{}' is out of range: not 0, and at most {:.0f}N", text, hid_force_max_n));
    }
    return force;
}

base::Result<double> parse_hid_travel(const std::string& text)
{
    auto travel = base::parse_quantity(text, base::length_kind);
    if (travel && !(*travel >= hid_travel_min_m && *travel <= hid_travel_max_m)) {
        return base::fail(fmt::format("'{}' is out of range: from {:.0f}mm to {:.0f}m", text,
                                      1e3 * hid_travel_min_m, hid_travel_max_m));
    }
    return travel;
}

/// One that is not for every device.
struct Belonging {
    const char* option;
    bool is_said;
    std::string_view backend;
};

/// What would be passed over in silence is a mistake that a person should hear of: a measured
/// force that does not count is no detail.
void refuse_options_of_others(Taker& taker, const DeviceTexts& texts)
{
    const std::array belongings{
        Belonging{"--operator", texts.person.has_value(), "sim"},
        Belonging{"--replay-loop", texts.replay_loops, "replay"},
        Belonging{"--hd-library", texts.hd_library.has_value(), "hdapi"},
        Belonging{"--falcon-firmware", texts.falcon_firmware.has_value(), "falcon"},
        Belonging{"--enable-uncalibrated-force", texts.uncalibrated_force, "omni1394"},
        Belonging{"--omni-torque", texts.omni_torque.has_value(), "omni1394"},
        Belonging{"--hid-force", texts.hid_force.has_value(), "hid"},
        Belonging{"--hid-travel", texts.hid_travel.has_value(), "hid"},
    };
    const std::string_view chosen =
        std::string_view{texts.device}.substr(0, texts.device.find(':'));
    for (const Belonging& one : belongings) {
        taker.require(!one.is_said || one.backend == chosen,
                      fmt::format("{}: it is for --device {}, and has no effect on --device {}: "
                                  "leave it out, or choose that device",
                                  one.option, one.backend == "replay" ? "replay:FILE" : one.backend,
                                  texts.device));
    }
}

void add_hd_library(CLI::App& app, DeviceTexts& texts)
{
    add_option(
        app, "--hd-library", texts.hd_library,
        {"hdapi: the vendor's library (default: libHD.so where the system finds it)", "FILE"});
}

void add_hid_force(CLI::App& app, DeviceTexts& texts)
{
    add_option(app, "--hid-force", texts.hid_force,
               {"hid: the force at the grip at full scale, measured; negative where it pushes the\n"
                "other way, as --hid-force=-5N (default: no force)",
                "FORCE"});
}

} // namespace

void add_device_options(CLI::App& app, DeviceTexts& texts)
{
    const auto add = [&app](const char* name, auto& text, const std::string& help,
                            const char* type) {
        add_option(app, name, text, {help, type});
    };
    add("--device", texts.device, device_help(), "sim|sim:joints|replay:FILE|BACKEND[:SERIAL]");
    add("--operator", texts.person,
        "Whose hand is simulated: relaxed, nominal (default), firm, lifelike, or a TOML file",
        "NAME|FILE");
    app.add_flag("--replay-loop", texts.replay_loops,
                 "replay:FILE begins again at its end, instead of staying there")
        ->group("Device");
    add("--mount-offset", texts.mount_offset,
        "Where in the scene the zero of a device is (default for a real one: the centre of its\n"
        "workspace is where the paper's cube starts)",
        "X,Y,Z");
    add("--mount-scale", texts.mount_scale,
        "Metres in the scene per metre of the device (default for a real one: as much as it\n"
        "needs to cover what an Omni does, 160 x 120 x 70 mm, at least 1). Forces grow with it",
        "NUMBER");
    add_hd_library(app, texts);
    add("--falcon-firmware", texts.falcon_firmware,
        "falcon: its firmware, which hapnet may not bring (default: it runs already)", "FILE");
    app.add_flag("--enable-uncalibrated-force", texts.uncalibrated_force,
                 "omni1394: force without a torque table, at most a quarter of full scale")
        ->group("Device");
    add("--omni-torque", texts.omni_torque,
        "omni1394: what its motors were measured to give per count (docs/use/hardware.md)", "FILE");
    add_hid_force(app, texts);
    add("--hid-travel", texts.hid_travel,
        "hid: how far the grip goes from stop to stop of an axis, measured: places, speeds and "
        "the\n"
        "limits for them go by it (default: 160mm)",
        "LENGTH");
}

void add_finding_options(CLI::App& app, DeviceTexts& texts)
{
    add_hd_library(app, texts);
    add_hid_force(app, texts);
}

void take_finding(device::DeviceOptions& options, Taker& taker, const DeviceTexts& texts)
{
    if (texts.hd_library) {
        taker.take(options.hd_library, "--hd-library", library_named(*texts.hd_library));
    }
    if (texts.hid_force) {
        taker.take(options.hid_force_n, "--hid-force", parse_hid_force(*texts.hid_force));
    }
}

void take_device(DeviceChoice& choice, Taker& taker, const DeviceTexts& texts)
{
    choice.name = texts.device;
    taker.take(choice.person, "--operator",
               device::load_operator(texts.person.value_or("nominal"), net::text_of_file));
    if (texts.mount_offset) {
        taker.take(choice.mount_offset, "--mount-offset", parse_offset(*texts.mount_offset));
    }
    if (texts.mount_scale) {
        taker.take(choice.mount_scale, "--mount-scale", parse_scale(*texts.mount_scale));
    }
    take_finding(choice.options, taker, texts);
    if (texts.falcon_firmware) {
        taker.take(choice.options.falcon_firmware, "--falcon-firmware",
                   firmware_at(*texts.falcon_firmware));
    }
    choice.options.uncalibrated_force = texts.uncalibrated_force;
    if (texts.omni_torque) {
        taker.take(choice.options.omni_torque, "--omni-torque",
                   omni_profile_at(*texts.omni_torque));
    }
    if (texts.hid_travel) {
        taker.take(choice.options.hid_travel_m, "--hid-travel",
                   parse_hid_travel(*texts.hid_travel));
    }
    if (texts.device.starts_with(replay_prefix)) {
        taker.take(choice.replay, "--device",
                   hand_trace_in(texts.device.substr(replay_prefix.size())));
        choice.replay_loops = texts.replay_loops;
    } else if (!choice.is_simulated()) {
        const auto name = device::parse_device_name(texts.device);
        taker.require(name.has_value(),
                      name ? "" : fmt::format("--device: {}", name.error().message));
    }
    refuse_options_of_others(taker, texts);
}

} // namespace hapnet::peer
