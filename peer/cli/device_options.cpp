// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/device_options.hpp"

#include "device/omni1394/drive.hpp"
#include "proto/base/quantity.hpp"
#include "proto/cli/synonyms.hpp"
#include "proto/net/text_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::peer {

namespace {

constexpr double mount_scale_max = 20.0;
constexpr double mount_scale_min = 0.05;
constexpr double hid_force_max_n = 100.0;
// The largest firmware. The loader of a Falcon takes 14 000 bytes a second, so a larger one would
// take longer than a minute.
constexpr std::size_t falcon_firmware_max_bytes = 1U << 20;
constexpr std::string_view replay_prefix = "replay:";
constexpr double hid_travel_min_m = 0.01;
constexpr double hid_travel_max_m = 5.0;

constexpr const char* group = "Device";

std::string device_help()
{
    std::string help =
        "sim (default): a simulated Omni in a simulated hand. sim:joints: the same with joints, "
        "encoders, motors and an inkwell. replay:FILE: a hand that moves as FILE says, CSV with "
        "time_s,x_m,y_m,z_m[,gripping][,docked] or as hapnet-lab export writes it. page: a "
        "simulated hand that clients of the control socket move. A real device, by its "
        "serial or the first one that is usable";
    help += fmt::format(" ({}):", device::never_run);
    for (const device::Backend& backend : device::backends()) {
        help += fmt::format("\n  {:<9} {}", backend.name, backend.what);
    }
    return help + "\nhapnet-peer list-devices shows the connected ones; see docs/use/hardware.md";
}

base::Result<device::HandTrace> hand_trace_in(const std::string& file)
{
    if (file.empty()) return base::fail("replay: needs a file, as in replay:hand.csv");
    const auto text = net::text_of_file(file);
    if (!text) return tl::unexpected{text.error()};
    return device::parse_hand_trace(*text, file);
}

/// Parses "0mm,20mm,-5mm".
base::Result<base::Displacement> parse_offset(const std::string& text)
{
    const auto refuse = [&] {
        return base::fail(
            fmt::format("'{}' is not an offset: write three lengths of at most 1m, such as "
                        "0mm,20mm,-5mm",
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

/// Checks that a file contains firmware, as far as possible without the device, and returns its
/// name.
base::Result<std::string> firmware_at(const std::string& file)
{
    const auto bytes = net::text_of_file(file);
    if (!bytes) return tl::unexpected{bytes.error()};
    if (bytes->empty()) return base::fail(fmt::format("{} is empty", file));
    if (bytes->size() <= falcon_firmware_max_bytes) return file;
    return base::fail(fmt::format("{} has {} bytes; the firmware of a Falcon has at most {}", file,
                                  bytes->size(), falcon_firmware_max_bytes));
}

/// Checks that a file contains the measured torques of an Omni's motors, and returns its name.
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

base::Result<std::uint16_t> parse_port(const std::string& text)
{
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc{} || end != text.data() + text.size() || port == 0) {
        return base::fail(fmt::format("'{}' is not a port: use a number from 1 to 65535", text));
    }
    return port;
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

/// Takes the value of --device. Opens the file of replay:FILE; other devices are not opened here.
base::Result<void> take_device(const std::string& typed, DeviceChoice& choice)
{
    const auto meant = cli::meant_value("--device", typed);
    if (!meant) return tl::unexpected{meant.error()};
    choice.name = *meant;
    if (choice.name.starts_with(replay_prefix)) {
        return cli::into(choice.replay, hand_trace_in)(choice.name.substr(replay_prefix.size()));
    }
    if (choice.name == "page") choice.page = std::make_shared<device::HandWishes>();
    if (choice.is_simulated() || choice.page) return {};
    const auto name = device::parse_device_name(choice.name);
    return name ? base::Result<void>{} : tl::unexpected{name.error()};
}

void add_hd_library(cli::Command& command, std::string& library)
{
    command
        .option("--hd-library", "FILE",
                "hdapi: the vendor's library (default: libHD.so where the system finds it)",
                cli::into(library, library_named))
        .under(group);
}

void add_dhd_library(cli::Command& command, std::string& library)
{
    command
        .option("--dhd-library", "FILE",
                "dhd: the vendor's library (default: libdhd.so where the system finds it)",
                cli::into(library, library_named))
        .under(group);
}

void add_inverse3_port(cli::Command& command, std::uint16_t& port)
{
    command
        .option("--inverse3-port", "PORT",
                "inverse3: of the vendor's service on this machine (default: 10001)",
                cli::into(port, parse_port))
        .under(group);
}

void add_hid_force(cli::Command& command, std::optional<double>& force_n)
{
    command
        .option("--hid-force", "FORCE",
                "hid: the measured force at the grip at full scale; negative where it pushes the "
                "other way, as in --hid-force=-5N (default: no force)",
                cli::into(force_n, parse_hid_force))
        .under(group);
}

} // namespace

cli::Option& add_device_options(cli::Command& command, DeviceChoice& choice)
{
    const auto add = [&command](const char* name, const char* value, std::string help,
                                cli::Take take) -> cli::Option& {
        return command.option(name, value, std::move(help), std::move(take)).under(group);
    };
    const auto load_operator = [](const std::string& name) {
        return device::load_operator(name, net::text_of_file);
    };
    choice.person = load_operator("nominal").value();
    auto& device = add("--device", "NAME[:SERIAL]", device_help(),
                       [&choice](const std::string& text) { return take_device(text, choice); });
    add("--operator", "NAME|FILE",
        "sim: whose hand is simulated: relaxed, nominal (default), firm, lifelike, or a TOML file",
        cli::into(choice.person, load_operator));
    command
        .flag("--replay-loop", "replay: start FILE again at its end instead of staying there",
              choice.replay_loops)
        .under(group);
    add("--mount-offset", "X,Y,Z",
        "Position in the scene of the device's zero, such as 0mm,20mm,-5mm (default for a real "
        "device: the centre of its "
        "workspace is where the paper's cube starts)",
        cli::into(choice.mount_offset, parse_offset));
    add("--mount-scale", "NUMBER",
        "Metres in the scene per metre of the device; forces grow with it (default for a real "
        "device: at least 1, and enough to cover an Omni's 160 x 120 x 70 mm)",
        cli::into(choice.mount_scale, base::Number{mount_scale_min, mount_scale_max}));
    add_hd_library(command, choice.options.hd_library);
    add_dhd_library(command, choice.options.dhd_library);
    add_inverse3_port(command, choice.options.inverse3_port);
    add("--falcon-firmware", "FILE",
        "falcon: its firmware, which Hapnet may not ship (default: it runs already)",
        cli::into(choice.options.falcon_firmware, firmware_at));
    command
        .flag("--enable-uncalibrated-force",
              "omni1394: force without a torque table, at most a quarter of full scale",
              choice.options.uncalibrated_force)
        .under(group);
    add("--omni-torque", "FILE",
        "omni1394: the measured torque of its motors per count (docs/use/devices.md)",
        cli::into(choice.options.omni_torque, omni_profile_at));
    add_hid_force(command, choice.options.hid_force_n);
    add("--hid-travel", "LENGTH",
        "hid: the measured travel of the grip from stop to stop of an axis; positions, speeds and "
        "their limits follow from it (default: 160mm)",
        cli::into(choice.options.hid_travel_m,
                  base::Quantity{base::length_kind, hid_travel_min_m, hid_travel_max_m}));
    return device;
}

void add_finding_options(cli::Command& command, device::DeviceOptions& options)
{
    add_hd_library(command, options.hd_library);
    add_dhd_library(command, options.dhd_library);
    add_inverse3_port(command, options.inverse3_port);
    add_hid_force(command, options.hid_force_n);
}

/// Refuses options that would otherwise be ignored silently, because a person should know that a
/// measured force has no effect.
base::Result<void> check_device_options(const cli::Command& command, const DeviceChoice& choice)
{
    struct OptionOfDevice {
        const char* option;
        std::string_view device;
    };
    constexpr std::array options{
        OptionOfDevice{"--operator", "sim"},
        OptionOfDevice{"--replay-loop", "replay"},
        OptionOfDevice{"--hd-library", "hdapi"},
        OptionOfDevice{"--dhd-library", "dhd"},
        OptionOfDevice{"--inverse3-port", "inverse3"},
        OptionOfDevice{"--falcon-firmware", "falcon"},
        OptionOfDevice{"--enable-uncalibrated-force", "omni1394"},
        OptionOfDevice{"--omni-torque", "omni1394"},
        OptionOfDevice{"--hid-force", "hid"},
        OptionOfDevice{"--hid-travel", "hid"},
    };
    const std::string_view chosen = std::string_view{choice.name}.substr(0, choice.name.find(':'));
    for (const auto& [option, device] : options) {
        if (!command.is_given(option) || device == chosen) continue;
        return base::fail(fmt::format("{}: it is for --device {}, and has no effect on --device "
                                      "{}: leave it out, or choose that device",
                                      option, device == "replay" ? "replay:FILE" : device,
                                      choice.name));
    }
    return {};
}

} // namespace hapnet::peer
