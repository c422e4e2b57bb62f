// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/doctor/findings.hpp"

#include "device/capabilities.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::doctor {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration late_worth_a_warning = 500us; // half a tick
constexpr base::Duration slack_wanted = 1us;
constexpr std::uint64_t buffer_wanted_bytes = 4U << 20; // what the peers' sockets ask for

double in_microseconds(base::Duration duration) { return 1e6 * base::to_seconds(duration); }

std::string_view what_is_withheld(const Timing& timing)
{
    if (timing.fifo) return "locked memory is";
    return timing.locked_memory ? "SCHED_FIFO is" : "SCHED_FIFO and locked memory are";
}

Finding on_priority(const Timing& timing)
{
    if (timing.fifo && timing.locked_memory) {
        return {"real time", Level::ok, "SCHED_FIFO and locked memory are granted"};
    }
    const std::string withheld =
        fmt::format("{} withheld: wake-ups will be later", what_is_withheld(timing));
    if (timing.is_root) {
        return {"real time", Level::warning, withheld,
                "run outside of this container or virtual machine, or let it have CAP_SYS_NICE and "
                "an unlimited memlock"};
    }
    return {"real time", Level::warning, withheld,
            "printf '@audio - rtprio 50\\n@audio - memlock unlimited\\n' | sudo tee "
            "/etc/security/limits.d/hapnet.conf && sudo usermod -aG audio \"$USER\"   # then log "
            "in again"};
}

Finding on_wake_ups(const Timing& timing)
{
    const double late_us = in_microseconds(timing.late_p99);
    if (timing.slack > slack_wanted) {
        return {"timers", Level::warning,
                fmt::format("timer slack stays at {:.0f} us", in_microseconds(timing.slack)),
                "run outside of the container or sandbox that withholds PR_SET_TIMERSLACK"};
    }
    const std::string text = fmt::format("p99 lateness of wake-ups: {:.0f} us", late_us);
    if (timing.late_p99 <= late_worth_a_warning) return {"timers", Level::ok, text};
    return {"timers", Level::warning, text,
            "end what keeps the processors busy, and see the findings on real time and on the "
            "processor's speed"};
}

Finding on_speed(const std::vector<std::string>& governors)
{
    if (governors.empty()) {
        return {"processor speed", Level::ok, "the system does not let it be set"};
    }
    std::string names;
    for (const std::string& one : governors) names += (names.empty() ? "" : ", ") + one;
    if (governors == std::vector<std::string>{"performance"}) {
        return {"processor speed", Level::ok, "performance"};
    }
    return {"processor speed", Level::warning,
            fmt::format("governor {}: a processor that has to wake up first is late", names),
            "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor"};
}

Finding on_buffers(const Facts& facts)
{
    const auto most = facts.receive_buffer_max_bytes;
    if (!most) return {"socket buffers", Level::ok, "the system does not tell their limit"};
    if (facts.forces_buffers || *most >= buffer_wanted_bytes) {
        return {"socket buffers", Level::ok, "4 MiB are granted"};
    }
    return {
        "socket buffers", Level::warning,
        fmt::format("at most {} KiB: messages may be lost while the loop is held up", *most / 1024),
        fmt::format("sudo sysctl -w net.core.rmem_max={}", buffer_wanted_bytes)};
}

Finding on_rules(const Facts& facts)
{
    if (facts.installed_rules && *facts.installed_rules == udev_rules()) {
        return {"udev rules", Level::ok, "installed"};
    }
    if (!facts.has_udev) return {"udev rules", Level::ok, "this system has no udev"};
    const char* text = facts.installed_rules ? "those of another version are installed"
                                             : "not installed: devices may be for root alone";
    return {"udev rules", Level::warning, text, std::string{udev_cure()}};
}

std::string cure_for(const Node& node)
{
    if (node.rule.empty()) return std::string{udev_cure()};
    return fmt::format("echo '{}' | sudo tee -a /etc/udev/rules.d/61-my-device.rules && "
                       "sudo udevadm control --reload && sudo udevadm trigger",
                       node.rule);
}

void judge_nodes(const Facts& facts, std::vector<Finding>& findings)
{
    for (const Node& node : facts.nodes) {
        if (node.is_accessible) {
            findings.push_back({"device", Level::ok,
                                fmt::format("{} at {} can be opened ({})", node.device, node.path,
                                            device::never_run)});
        } else {
            findings.push_back(
                {"device", Level::bad,
                 fmt::format("no permission to open {}, the {}", node.path, node.device),
                 fmt::format("{}   # then plug it in again", cure_for(node))});
        }
    }
    if (facts.nodes.empty()) {
        findings.push_back({"device", Level::ok, "none that hapnet knows is connected"});
    }
}

Finding on_firewire(const Facts& facts)
{
    if (!facts.has_firewire_card) {
        return {"FireWire", Level::ok, "no card, which only a FireWire Omni would need"};
    }
    if (facts.has_firewire_driver) return {"FireWire", Level::ok, "card and driver are there"};
    return {"FireWire", Level::bad, "there is a card, but its driver is not loaded",
            "sudo modprobe firewire-ohci"};
}

Finding on_hd(const Facts& facts)
{
    if (!facts.hd_wanted) {
        return {"libHD", Level::ok, "not looked for: only devices of 3D Systems need it"};
    }
    if (facts.hd_trouble.empty()) {
        return {"libHD", Level::ok, "it can be loaded"};
    }
    return {
        "libHD", Level::bad, facts.hd_trouble,
        "install OpenHaptics and the device's driver from 3D Systems, or give --hd-library FILE"};
}

/// Handshakes contain the date, and one that is older than the last is refused.
Finding on_date(bool is_set)
{
    if (is_set) return {"date", Level::ok, "the clock is set, as sessions with keys want it"};
    return {"date", Level::warning,
            "the clock is years behind: sessions with keys may take seconds to begin",
            "sudo timedatectl set-ntp true"};
}

Finding on_key(const KeyFact& key)
{
    if (!key.trouble.empty()) return {"key file", Level::bad, key.trouble};
    return {"key file", Level::ok, key.path + " is readable, and for its owner alone"};
}

} // namespace

std::vector<Finding> judge(const Facts& facts)
{
    std::vector<Finding> findings{on_priority(facts.timing), on_wake_ups(facts.timing),
                                  on_speed(facts.cpu_governors), on_buffers(facts),
                                  on_rules(facts)};
    judge_nodes(facts, findings);
    findings.push_back(on_firewire(facts));
    findings.push_back(on_hd(facts));
    findings.push_back(on_date(facts.is_date_set));
    if (facts.key) findings.push_back(on_key(*facts.key));
    return findings;
}

std::string_view udev_cure()
{
    return "hapnet-peer doctor --print-udev-rules | sudo tee /etc/udev/rules.d/60-hapnet.rules "
           "&& sudo udevadm control --reload && sudo udevadm trigger";
}

} // namespace hapnet::peer::doctor
