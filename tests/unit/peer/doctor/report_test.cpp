// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/doctor/report.hpp"
#include "peer/doctor/system.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hapnet::peer::doctor {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

Facts a_good_machine()
{
    Facts facts;
    facts.timing = {
        .fifo = true, .locked_memory = true, .is_root = false, .slack = 1ns, .late_p99 = 60us};
    facts.cpu_governors = {"performance"};
    facts.receive_buffer_max_bytes = 4U << 20;
    facts.has_udev = true;
    facts.installed_rules = std::string{udev_rules()};
    facts.has_firewire_card = facts.has_firewire_driver = true;
    return facts;
}

/// The finding on a subject after a single change on a good machine.
template <typename Change>
Finding finding_on(const char* subject, Change change)
{
    Facts facts = a_good_machine();
    change(facts);
    for (const Finding& one : judge(facts)) {
        if (one.subject == subject) return one;
    }
    return {"none", Level::ok, "", ""};
}

/// A root of a file system with the files of a test.
class FakeRoot : public ::testing::Test {
protected:
    FakeRoot()
        : root_{fs::path{testing::TempDir()} /
                ("hapnet-root-" +
                 std::string{testing::UnitTest::GetInstance()->current_test_info()->name()})}
    {
        fs::remove_all(root_);
    }
    ~FakeRoot() override { fs::remove_all(root_); }

    void put(const fs::path& file, const std::string& text) const
    {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream{root_ / file} << text;
    }
    [[nodiscard]] Facts facts() const { return look_at(root_, "/no/such/libHD.so"); }

    fs::path root_;
};

} // namespace

TEST(Doctor, FindsNothingToMendOnAGoodMachine)
{
    for (const Finding& one : judge(a_good_machine())) {
        EXPECT_EQ(one.level, Level::ok) << one.subject << ": " << one.text;
        EXPECT_FALSE(one.cure) << one.subject;
    }
}

TEST(Doctor, GivesAOneLineCureForAllThatCouldBeBetter)
{
    const auto expect_cure = [](const Finding& one, Level level, const char* words) {
        EXPECT_EQ(one.level, level) << one.subject;
        ASSERT_TRUE(one.cure) << one.subject;
        EXPECT_NE(one.cure->find(words), std::string::npos) << one.subject << ": " << *one.cure;
        EXPECT_EQ(one.cure->find('\n'), std::string::npos) << one.subject;
    };
    expect_cure(finding_on("real time", [](Facts& f) { f.timing.fifo = false; }), Level::warning,
                "/etc/security/limits.d");
    expect_cure(
        finding_on("real time", [](Facts& f) { f.timing.fifo = false, f.timing.is_root = true; }),
        Level::warning, "container");
    expect_cure(finding_on("timers", [](Facts& f) { f.timing.slack = 50us; }), Level::warning,
                "PR_SET_TIMERSLACK");
    expect_cure(finding_on("timers", [](Facts& f) { f.timing.late_p99 = 501us; }), Level::warning,
                "busy");
    expect_cure(finding_on("processor speed", [](Facts& f) { f.cpu_governors = {"powersave"}; }),
                Level::warning, "scaling_governor");
    expect_cure(finding_on("socket buffers", [](Facts& f) { f.receive_buffer_max_bytes = 212992; }),
                Level::warning, "sysctl -w net.core.rmem_max=4194304");
    expect_cure(finding_on("udev rules", [](Facts& f) { f.installed_rules.reset(); }),
                Level::warning, "doctor --print-udev-rules | sudo tee /etc/udev/rules.d");
    expect_cure(finding_on("udev rules", [](Facts& f) { f.installed_rules = "old"; }),
                Level::warning, "udevadm");
    expect_cure(finding_on("device",
                           [](Facts& f) {
                               f.nodes = {{"Novint Falcon", "/dev/bus/usb/001/002", false}};
                           }),
                Level::bad, "udev");
    expect_cure(finding_on("FireWire", [](Facts& f) { f.has_firewire_driver = false; }), Level::bad,
                "modprobe firewire-ohci");
    expect_cure(
        finding_on("libHD", [](Facts& f) { f.hd_trouble = "not there", f.hd_wanted = true; }),
        Level::bad, "OpenHaptics");
}

TEST(Doctor, SaysOfADeviceThatItMayUseThatItNeverRanOnOne)
{
    const Finding one = finding_on("device", [](Facts& f) {
        f.nodes = {{"Novint Falcon", "/dev/bus/usb/001/002", true}};
    });
    EXPECT_EQ(one.level, Level::ok);
    EXPECT_NE(one.text.find("never run on the physical device"), std::string::npos);
}

TEST(Doctor, DoesNotMissALibraryThatNoDeviceNeeds)
{
    const Finding one = finding_on("libHD", [](Facts& f) { f.hd_trouble = "not there"; });
    EXPECT_EQ(one.level, Level::ok);
}

TEST(Doctor, SaysHowToSetADateThatIsYearsBehind)
{
    EXPECT_EQ(finding_on("date", [](Facts&) {}).level, Level::ok);
    const Finding one = finding_on("date", [](Facts& f) { f.is_date_set = false; });
    EXPECT_EQ(one.level, Level::warning);
    EXPECT_NE(one.cure.value().find("timedatectl"), std::string::npos);
}

TEST(Doctor, SaysWhyAKeyFileWouldBeRefused)
{
    const Finding good = finding_on("key file", [](Facts& f) { f.key = KeyFact{"my.key"}; });
    EXPECT_EQ(good.level, Level::ok);
    const Finding bad = finding_on("key file", [](Facts& f) {
        f.key = KeyFact{"my.key", "others may use it"};
    });
    EXPECT_EQ(bad.level, Level::bad);
    EXPECT_EQ(bad.text, "others may use it");
}

TEST(Doctor, PrintsATableAndJsonWithEveryFinding)
{
    Facts facts = a_good_machine();
    facts.has_firewire_driver = false;
    const Examination examined = examine(facts);
    EXPECT_TRUE(examined.has_bad);
    EXPECT_NE(text_of(examined).find("fix: sudo modprobe"), std::string::npos);
    const auto json = nlohmann::json::parse(json_text_of(examined));
    EXPECT_EQ(json["bad"], true);
    ASSERT_EQ(json["findings"].size(), examined.findings.size());
    EXPECT_TRUE(json["findings"][0]["fix"].is_null());
}

TEST_F(FakeRoot, FindsDevicesAndWhetherTheyMayBeOpened)
{
    put("sys/bus/usb/devices/1-2/idVendor", "0403\n");
    put("sys/bus/usb/devices/1-2/idProduct", "cb48\n");
    put("sys/bus/usb/devices/1-2/busnum", "1\n");
    put("sys/bus/usb/devices/1-2/devnum", "7\n");
    put("dev/bus/usb/001/007", "");
    put("sys/bus/usb/devices/1-3/idVendor", "0403\n"); // a serial adapter
    put("sys/bus/usb/devices/1-3/idProduct", "6001\n");
    put("sys/bus/firewire/devices/fw1/vendor", "0x000b99\n");
    put("sys/bus/firewire/devices/fw1.0/vendor", "0x000b99\n");
    put("sys/class/hidraw/hidraw3/device/uevent",
        "DRIVER=hid-generic\nHID_ID=0003:0000256F:0000C62F\nHID_NAME=x\n");
    put("dev/hidraw3", "");
    put("sys/class/hidraw/hidraw4/device/uevent", "HID_ID=0003:0000046D:0000C077\n"); // a mouse
    put("sys/class/hidraw/hidraw5/device/uevent", "HID_ID=00");
    // Not in the rules, but with a Set Effect report in its descriptor.
    put("sys/class/hidraw/hidraw6/device/uevent", "HID_ID=0003:0000EB03:00002402\n");
    put("sys/class/hidraw/hidraw6/device/report_descriptor", "\x05\x0f\x09\x21\xa1\x02\xc0");
    const Facts found = facts();
    const auto& nodes = found.nodes;
    ASSERT_EQ(nodes.size(), 4U);
    EXPECT_EQ(nodes[0].device, "Novint Falcon");
    EXPECT_EQ(nodes[0].path, "/dev/bus/usb/001/007");
    EXPECT_TRUE(nodes[0].is_accessible);
    EXPECT_EQ(nodes[1].path, "/dev/fw1");
    EXPECT_FALSE(nodes[1].is_accessible); // there is no such node
    EXPECT_EQ(nodes[2].device, "SpaceMouse Wireless (receiver)");
    EXPECT_EQ(nodes[2].path, "/dev/hidraw3");
    EXPECT_EQ(nodes[3].path, "/dev/hidraw6");
    const auto findings = judge(found);
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& one) {
        return one.cure.value_or("").find(
                   R"(ATTRS{idVendor}=="eb03", ATTRS{idProduct}=="2402", TAG+="uaccess")") !=
               std::string::npos;
    }));
}

TEST_F(FakeRoot, FindsTheSerialPortOfATouchAndNoOther)
{
    for (const auto& [usb, product] : {std::pair{"1-4", "0302\n"}, {"1-5", "6001\n"}}) {
        const std::string device = std::string{"sys/devices/usb1/"} + usb;
        put(device + "/idVendor", "2988\n");
        put(device + "/idProduct", product);
        put(device + "/interface/bInterfaceClass", "02\n");
    }
    for (const auto& [port, usb] : {std::pair{"ttyACM0", "1-4"}, {"ttyACM1", "1-5"}}) {
        put(std::string{"sys/class/tty/"} + port + "/dev", "166:0\n");
        fs::create_directory_symlink(root_ / "sys/devices/usb1" / usb / "interface",
                                     root_ / "sys/class/tty" / port / "device");
    }
    put("sys/class/tty/tty1/dev", "4:1\n");
    put("dev/ttyACM0", "");
    const auto nodes = facts().nodes;
    ASSERT_EQ(nodes.size(), 1U);
    EXPECT_EQ(nodes[0].device, "Touch");
    EXPECT_EQ(nodes[0].path, "/dev/ttyACM0");
    EXPECT_TRUE(nodes[0].is_accessible);
}

TEST_F(FakeRoot, FindsATouchThatIsAHidDeviceAndAnyDeviceOfForceDimension)
{
    put("sys/class/hidraw/hidraw2/device/uevent", "HID_ID=0003:00002988:00000304\n");
    put("dev/hidraw2", "");
    put("sys/bus/usb/devices/1-2/idVendor", "1451\n");
    put("sys/bus/usb/devices/1-2/idProduct", "0402\n");
    put("sys/bus/usb/devices/1-2/busnum", "1\n");
    put("sys/bus/usb/devices/1-2/devnum", "3\n");
    put("dev/bus/usb/001/003", "");
    const auto nodes = facts().nodes;
    ASSERT_EQ(nodes.size(), 2U);
    EXPECT_EQ(nodes[0].device, "Force Dimension");
    EXPECT_EQ(nodes[0].path, "/dev/bus/usb/001/003");
    EXPECT_EQ(nodes[1].device, "Touch");
    EXPECT_EQ(nodes[1].path, "/dev/hidraw2");
    EXPECT_TRUE(nodes[0].is_accessible && nodes[1].is_accessible);
}

TEST_F(FakeRoot, ReadsWhatTheKernelTells)
{
    put("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n");
    put("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance\n");
    put("sys/devices/system/cpu/cpu2/cpufreq/scaling_governor", "powersave\n");
    put("proc/sys/net/core/rmem_max", "212992\n");
    put("etc/udev/rules.d/60-hapnet.rules", std::string{udev_rules()});
    put("sys/bus/pci/devices/0000:03:00.0/class", "0x0c0010\n");
    const Facts found = facts();
    EXPECT_EQ(found.cpu_governors, (std::vector<std::string>{"performance", "powersave"}));
    EXPECT_EQ(found.receive_buffer_max_bytes, 212992U);
    EXPECT_EQ(found.installed_rules, udev_rules());
    EXPECT_TRUE(found.has_udev);
    EXPECT_TRUE(found.has_firewire_card);
    EXPECT_FALSE(found.has_firewire_driver);
    EXPECT_NE(found.hd_trouble.find("/no/such/libHD.so"), std::string::npos);
    EXPECT_GT(found.timing.late_p99, 0ns);
}

TEST_F(FakeRoot, TakesAnEmptySystemAsItIs)
{
    const Facts found = facts();
    EXPECT_TRUE(found.nodes.empty());
    EXPECT_TRUE(found.cpu_governors.empty());
    EXPECT_FALSE(found.receive_buffer_max_bytes);
    EXPECT_FALSE(found.installed_rules);
}

} // namespace hapnet::peer::doctor
