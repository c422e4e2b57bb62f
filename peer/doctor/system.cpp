// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/doctor/system.hpp"

#include "device/hdapi/transport/configuration.hpp"
#include "device/hdapi/transport/shared_library.hpp"
#include "device/hid/pid_layout.hpp"
#include "device/transport/usb_models.hpp"
#include "device/usb_ids.hpp"
#include "proto/base/histogram.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/real_time.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <sys/prctl.h>
#include <thread>
#include <unistd.h>

namespace hapnet::peer::doctor {

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int servo_priority = 45; // same as the loop of a session
constexpr int wake_ups = 300;

/// Returns the content of a file without the line end; nullopt if it cannot be read.
std::optional<std::string> text_in(const fs::path& file)
{
    std::ifstream in{file};
    if (!in) return std::nullopt;
    std::string text{std::istreambuf_iterator<char>{in}, {}};
    return text;
}

std::string word_in(const fs::path& file)
{
    std::ifstream in{file};
    std::string word;
    in >> word;
    return word;
}

/// Returns the sorted entries of a folder; none if there is no folder.
std::vector<fs::path> entries_of(const fs::path& folder)
{
    std::error_code error;
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator{folder, error}) entries.push_back(entry);
    std::sort(entries.begin(), entries.end());
    return entries;
}

std::uint16_t number_of(const std::string& hexadecimal)
{
    return static_cast<std::uint16_t>(std::strtoul(hexadecimal.c_str(), nullptr, 16));
}

Node node_at(const fs::path& root, std::string_view device, const std::string& path)
{
    const fs::path here = root / path.substr(1);
    return {std::string{device}, path, access(here.c_str(), R_OK | W_OK) == 0};
}

void find_usb(const fs::path& root, std::vector<Node>& nodes)
{
    for (const fs::path& entry : entries_of(root / "sys/bus/usb/devices")) {
        const auto* const id = device::find_usb_id(number_of(word_in(entry / "idVendor")),
                                                   number_of(word_in(entry / "idProduct")));
        if (id == nullptr || id->node != device::UsbNode::usb) continue;
        const auto number = [&](const char* file) {
            return fmt::format("{:0>3}", word_in(entry / file));
        };
        nodes.push_back(node_at(
            root, id->name, fmt::format("/dev/bus/usb/{}/{}", number("busnum"), number("devnum"))));
    }
}

void find_firewire(const fs::path& root, std::vector<Node>& nodes)
{
    for (const fs::path& entry : entries_of(root / "sys/bus/firewire/devices")) {
        if (word_in(entry / "vendor") != "0x000b99") continue;
        const std::string name = entry.filename();
        if (name.find('.') != std::string::npos) continue; // a unit of a device, not the device
        nodes.push_back(node_at(root, "PHANToM Omni (FireWire)", "/dev/" + name));
    }
}

/// True if this report descriptor, by which a device describes itself, includes force feedback (USB
/// HID PID).
bool has_force(const fs::path& report_descriptor)
{
    const auto text = text_in(report_descriptor);
    if (!text) return false;
    const auto descriptor = device::hid::parse_descriptor(std::as_bytes(std::span{*text}));
    return descriptor && device::hid::is_force_device(*descriptor);
}

std::string rule_for(std::uint16_t vendor, std::uint16_t product)
{
    return fmt::format(R"(SUBSYSTEM=="hidraw", ATTRS{{idVendor}}=="{:04x}", )"
                       R"(ATTRS{{idProduct}}=="{:04x}", TAG+="uaccess")",
                       vendor, product);
}

/// "HID_ID=0003:00001209:0000FFB0"
void find_hid(const fs::path& root, std::vector<Node>& nodes)
{
    for (const fs::path& entry : entries_of(root / "sys/class/hidraw")) {
        const std::string text = text_in(entry / "device/uevent").value_or("");
        const auto at = text.find("HID_ID=");
        constexpr std::size_t length = 28; // length of "HID_ID=bbbb:vvvvvvvv:pppppppp"
        if (at == std::string::npos || text.size() < at + length + 1) continue;
        const std::uint16_t vendor = number_of(text.substr(at + 16, 4));
        const std::uint16_t product = number_of(text.substr(at + 25, 4));
        const std::string path = "/dev/" + entry.filename().string();
        const auto* const id = device::find_usb_id(vendor, product);
        if (id != nullptr && id->node == device::UsbNode::hidraw) {
            nodes.push_back(node_at(root, id->name, path));
        } else if (has_force(entry / "device/report_descriptor")) {
            Node node = node_at(root, "HID force-feedback device", path);
            node.rule = rule_for(vendor, product);
            nodes.push_back(std::move(node));
        }
    }
}

/// Adds serial ports. The ids of their devices are one folder above the interface that the port
/// belongs to.
void find_serial(const fs::path& root, std::vector<Node>& nodes)
{
    for (const fs::path& entry : entries_of(root / "sys/class/tty")) {
        std::error_code error;
        const fs::path interface = fs::canonical(entry / "device", error);
        if (error) continue; // not backed by hardware
        const auto* const id =
            device::find_usb_id(number_of(word_in(interface.parent_path() / "idVendor")),
                                number_of(word_in(interface.parent_path() / "idProduct")));
        if (id == nullptr || id->node != device::UsbNode::tty) continue;
        nodes.push_back(node_at(root, id->name, "/dev/" + entry.filename().string()));
    }
}

std::optional<std::string> rules_in(const fs::path& root)
{
    for (const char* folder : {"etc/udev/rules.d", "run/udev/rules.d", "usr/local/lib/udev/rules.d",
                               "usr/lib/udev/rules.d", "lib/udev/rules.d"}) {
        if (auto text = text_in(root / folder / "60-hapnet.rules")) return text;
    }
    return std::nullopt;
}

bool has_firewire_card(const fs::path& root)
{
    const auto cards = entries_of(root / "sys/bus/pci/devices");
    return std::any_of(cards.begin(), cards.end(), [](const fs::path& card) {
        return word_in(card / "class").starts_with("0x0c00"); // IEEE 1394
    });
}

constexpr double year_2026_unix_s = 1'767'225'600.0;

/// Measures the timing that the loop of a peer would have, on a separate thread.
Timing try_timing()
{
    Timing timing;
    base::DurationHistogram late;
    std::jthread{[&] {
        const net::RealTime granted = net::request_real_time(servo_priority);
        timing.fifo = granted.fifo;
        timing.locked_memory = granted.locked_memory;
        timing.is_root = geteuid() == 0;
        timing.slack = std::chrono::nanoseconds{prctl(PR_GET_TIMERSLACK, 0UL, 0UL, 0UL, 0UL)};
        base::TimePoint due = net::monotonic_now();
        for (int i = 0; i < wake_ups; ++i) {
            due += 1ms;
            net::sleep_until(due);
            late.add(net::monotonic_now() - due);
        }
    }}.join();
    timing.late_p99 = late.quantile(0.99).value_or(base::Duration{});
    return timing;
}

} // namespace

Facts look_at(const fs::path& root, const std::string& hd_library)
{
    Facts facts;
    facts.timing = try_timing();
    facts.is_date_set = net::wall_clock_seconds() > year_2026_unix_s;
    std::set<std::string> governors;
    for (const fs::path& cpu : entries_of(root / "sys/devices/system/cpu")) {
        if (auto name = word_in(cpu / "cpufreq/scaling_governor"); !name.empty()) {
            governors.insert(std::move(name));
        }
    }
    facts.cpu_governors.assign(governors.begin(), governors.end());
    if (const auto text = word_in(root / "proc/sys/net/core/rmem_max"); !text.empty()) {
        facts.receive_buffer_max_bytes = std::strtoull(text.c_str(), nullptr, 10);
    }
    facts.forces_buffers = geteuid() == 0;
    facts.has_udev = fs::exists(root / "run/udev") || fs::exists(root / "etc/udev");
    facts.installed_rules = rules_in(root);
    find_usb(root, facts.nodes);
    find_firewire(root, facts.nodes);
    find_hid(root, facts.nodes);
    find_serial(root, facts.nodes);
    facts.has_firewire_card = has_firewire_card(root);
    facts.has_firewire_driver = fs::exists(root / "sys/bus/firewire");
    facts.hd_wanted = !hd_library.empty() ||
                      !device::models_on_usb(device::UsbKind::touch).empty() ||
                      !device::hdapi::configured_names().empty();
    if (!facts.hd_wanted) return facts; // loading a library would run its code
    if (const auto library = device::hdapi::load_library(hd_library); !library) {
        facts.hd_trouble = library.error().message;
    }
    return facts;
}

} // namespace hapnet::peer::doctor
