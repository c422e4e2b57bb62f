// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The rules open the nodes of just those devices that the backends know by their numbers.
#include "device/omni1394/registers.hpp"
#include "device/usb_ids.hpp"
#include "peer/doctor/findings.hpp"

#include <fnmatch.h>
#include <gtest/gtest.h>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <sstream>

namespace hapnet::peer::doctor {
namespace {

std::vector<std::string> rules_about(const std::string& part)
{
    std::vector<std::string> rules;
    std::istringstream text{std::string{udev_rules()}};
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with('#') && line.find(part) != std::string::npos) rules.push_back(line);
    }
    return rules;
}

/// The text between the quotes behind `key`.
std::string value_of(const std::string& rule, const std::string& key)
{
    const auto at = rule.find(key);
    if (at == std::string::npos) return "";
    const auto begin = rule.find('"', at) + 1;
    return rule.substr(begin, rule.find('"', begin) - begin);
}

/// True if a name matches, as udev reads patterns: alternatives of shell patterns.
bool matches(const std::string& pattern, const std::string& text)
{
    std::istringstream alternatives{pattern};
    for (std::string one; std::getline(alternatives, one, '|');) {
        if (fnmatch(one.c_str(), text.c_str(), 0) == 0) return true;
    }
    return false;
}

TEST(UdevRules, OpenAllUsbDevicesThatAreKnownByTheirNumbersAndNoOthers)
{
    std::set<std::string> known;
    for (const device::UsbId& id : device::usb_ids) {
        constexpr std::array<const char*, 3> subsystems{"usb", "hidraw", "tty"};
        known.insert(fmt::format("{} {:04x} {:04x}",
                                 subsystems.at(static_cast<std::size_t>(id.node)), id.vendor,
                                 id.product));
    }
    std::set<std::string> opened;
    for (const std::string& rule : rules_about("{idVendor}")) {
        const std::string products = value_of(rule, "{idProduct}");
        if (products.empty()) { // all of the vendor's
            opened.insert(value_of(rule, "SUBSYSTEM") + " " + value_of(rule, "{idVendor}") +
                          " 0000");
            continue;
        }
        for (unsigned product = 0; product <= 0xffff; ++product) {
            const std::string number = fmt::format("{:04x}", product);
            if (!matches(products, number)) continue;
            opened.insert(value_of(rule, "SUBSYSTEM") + " " + value_of(rule, "{idVendor}") + " " +
                          number);
        }
    }
    EXPECT_EQ(opened, known);
}

TEST(UdevRules, OpenTheSpaceMousesThatComeByBluetooth)
{
    const auto rules = rules_about("KERNELS");
    ASSERT_EQ(rules.size(), 1U);
    for (const device::UsbId& id : device::usb_ids) {
        const std::string device = fmt::format("0005:{:04X}:{:04X}.0001", id.vendor, id.product);
        EXPECT_EQ(matches(value_of(rules[0], "KERNELS"), device),
                  id.name.find("(Bluetooth)") != std::string_view::npos)
            << device;
    }
}

TEST(UdevRules, OpenTheOmnisOnFireWire)
{
    const auto rules = rules_about("firewire");
    ASSERT_EQ(rules.size(), 1U);
    EXPECT_EQ(value_of(rules[0], "ATTR{vendor}"),
              fmt::format("0x{:06x}", device::omni1394::vendor_id));
}

} // namespace
} // namespace hapnet::peer::doctor
