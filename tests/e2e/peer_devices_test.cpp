// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A person's steps before a session with a real device: list, check, test.
#include "tests/e2e/peer.hpp"
#include "tests/e2e/process.hpp"
#include "tests/support/fake_hd/fake_hd.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

Outcome peer(const std::vector<std::string>& words) { return run("hapnet-peer", words, 40s); }

void expect_said(const std::string& text, const std::vector<std::string>& words)
{
    for (const std::string& word : words) {
        EXPECT_NE(text.find(word), std::string::npos) << word << " is not in:\n" << text;
    }
}

json step_of(const json& report, const std::string& name)
{
    const auto& steps = report["steps"];
    const auto found = std::find_if(steps.begin(), steps.end(),
                                    [&](const json& step) { return step["step"] == name; });
    return found == steps.end() ? json{} : *found;
}

} // namespace

TEST(PeerDevices, ListsWithExitZeroWhetherOrNotThereAreAny)
{
    const auto table = peer({"list-devices"});
    EXPECT_EQ(table.exit, 0) << table.err;
    EXPECT_FALSE(table.out.empty());
    const auto listed = json::parse(peer({"list-devices", "--json"}).out);
    EXPECT_TRUE(listed["devices"].is_array());
    if (listed["devices"].empty()) expect_said(table.out, {"hapnet-peer doctor", "--device sim"});
}

TEST(PeerDevices, ListsWhatCannotBeUsedWithTheReasonAndTheCure)
{
    const std::vector<std::string> command{"list-devices", "--hd-library", "/no/such/libHD.so"};
    const auto table = peer(command);
    EXPECT_EQ(table.exit, 0);
    expect_said(table.out, {"hdapi", "library-missing", "/no/such/libHD.so", "OpenHaptics",
                            "never run on the physical device"});
    const auto other = peer({"list-devices", "--dhd-library", "/no/such/libdhd.so"});
    EXPECT_EQ(other.exit, 0);
    expect_said(other.out, {"dhd", "library-missing", "/no/such/libdhd.so", "Force Dimension",
                            "never run on the physical device"});
}

TEST(PeerDevices, ListsWhatCanBeUsedAndThatNobodyHas)
{
    const auto listed =
        json::parse(peer({"list-devices", "--json", "--hd-library", HAPNET_FAKE_HD}).out);
    const auto& devices = listed["devices"];
    const auto found = std::find_if(devices.begin(), devices.end(),
                                    [](const json& one) { return one["backend"] == "hdapi"; });
    ASSERT_NE(found, devices.end());
    EXPECT_EQ((*found)["usable"], true);
    EXPECT_EQ((*found)["note"], "never run on the physical device");
}

TEST(PeerDevices, TellsWhatTheMachineGrantsAndHowToMendTheRest)
{
    const auto outcome = peer({"doctor", "--json"});
    const auto report = json::parse(outcome.out);
    EXPECT_EQ(outcome.exit, report["bad"] == true ? 3 : 0) << outcome.out;
    std::vector<std::string> subjects;
    for (const json& one : report["findings"]) {
        subjects.push_back(one["subject"]);
        EXPECT_EQ(one["level"] == "ok", one["fix"].is_null()) << one;
    }
    for (const char* subject : {"real time", "timers", "processor speed", "socket buffers",
                                "udev rules", "device", "FireWire", "libHD"}) {
        EXPECT_NE(std::find(subjects.begin(), subjects.end(), subject), subjects.end()) << subject;
    }
    const auto table = peer({"doctor"});
    expect_said(table.out, {"real time", "socket buffers"});
}

TEST(PeerDevices, PrintsItsUdevRulesForTheDoctorsCure)
{
    const auto rules = peer({"doctor", "--print-udev-rules"});
    EXPECT_EQ(rules.exit, 0);
    expect_said(rules.out, {"0x000b99", "cb48", "hidraw", "uaccess", "SPDX-License-Identifier"});
}

TEST(PeerDevices, TestsTheSimulatedDeviceWithoutAPerson)
{
    const TemporaryFolder folder;
    const auto outcome = peer({"self-test", "--device", "sim", "--read-for", "500ms", "--json",
                               folder.file("report.json")});
    EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
    expect_said(outcome.out, {"passed   read", "0.9 to 1.1 ms", "###", "passed   calibrate",
                              "passed   force", "skipped  cable"});
    const auto report = json::parse(text_of(folder.file("report.json")));
    EXPECT_EQ(report["failed"], false);
    EXPECT_EQ(report["finished"], true);
    EXPECT_EQ(report["passed"], true);
    EXPECT_EQ(report["device"]["capabilities"]["stiffness_max_n_per_m"], 700.0);
    EXPECT_GT(step_of(report, "read")["rate_hz"], 200.0);
    EXPECT_NEAR(step_of(report, "force")["force_max_n"], 0.2, 1e-9);
}

TEST(PeerDevices, TestsTheSimulatedJointsWhosePersonTakesTheStylusOutOfItsInkwell)
{
    const auto outcome = peer({"self-test", "--device", "sim:joints", "--skip", "read", "--skip",
                               "force"}); // its other steps are those of sim
    EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
    expect_said(outcome.out, {"passed   calibrate"});
}

TEST(PeerDevices, TestsADeviceThatPacesTheLoopAndPromptsItsPerson)
{
    const TemporaryFolder folder;
    Process test{"hapnet-peer",
                 {"self-test", "--device", "hdapi:Left", "--hd-library", HAPNET_FAKE_HD,
                  "--read-for", "500ms", "--json", folder.file("report.json")}};
    EXPECT_TRUE(test.wait_for_err("never run on the physical device", 5s)) << test.err();
    EXPECT_TRUE(test.wait_for_err("put the stylus into its holder", 10s)) << test.err();
    test.signal(SIGINT);
    EXPECT_EQ(test.wait_exit(5s), 1);
    const auto report = json::parse(text_of(folder.file("report.json")));
    EXPECT_EQ(step_of(report, "read")["verdict"], "passed") << report;
    EXPECT_EQ(step_of(report, "force")["text"], "the test was broken off");
    EXPECT_EQ(report["finished"], false);
    EXPECT_EQ(report["passed"], false);
    expect_said(test.out(), {"NOT FINISHED"});
}

TEST(PeerDevices, LeavesStepsOut)
{
    const auto outcome =
        peer({"self-test", "--device", "sim", "--skip", "read", "--skip", "force"});
    EXPECT_EQ(outcome.exit, 0);
    expect_said(outcome.out, {"skipped  read", "passed   calibrate", "skipped  force"});
}

TEST(PeerDevices, RefusesBadUsageNamingTheCure)
{
    struct Case {
        std::vector<std::string> words;
        int exit;
        std::vector<std::string> said;
    };
    const std::string free = "127.0.0.1:9";
    for (const Case& c : {
             Case{{"list-devices", "--jsn"}, 2, {"--jsn", "did you mean --json?"}},
             Case{{"doctor", "now"}, 2, {"unexpected 'now'", "hapnet-peer doctor [OPTIONS]"}},
             Case{{"self-test"}, 2, {"--device is required", "list-devices"}},
             Case{{"self-test", "--device", "sim", "--skip", "all"}, 2, {"--skip", "cable"}},
             Case{{"self-test", "--device", "sim", "--read-for", "0"}, 2, {"--read-for", "100ms"}},
             Case{{"self-test", "--device", "omnix"}, 2, {"'omnix'", "hdapi"}},
             Case{{"self-test", "--device", "hdapi", "--hd-library", "/no/hd"}, 3, {"/no/hd"}},
             Case{{"self-test", "--device", "hdapi:Rigth", "--hd-library", HAPNET_FAKE_HD},
                  3,
                  {"'Rigth'", "Default PHANToM"}},
             Case{{"--remote", free, "--device", "hdapi", "--hd-library", "/no/hd"},
                  3,
                  {"--device hdapi", "/no/hd", "--hd-library"}},
             Case{{"--remote", free, "--mount-offset", "1mm,2mm"}, 2, {"0mm,20mm,-5mm"}},
             Case{{"--remote", free, "--mount-scale", "-1"}, 2, {"0.05 to 20"}},
             Case{{"--remote", free, "--hid-force", "0N"}, 2, {"--hid-force", "not 0"}},
             Case{{"--remote", free, "--device", "hid:1", "--omni-torque", "/no.toml"},
                  2,
                  {"--omni-torque", "/no.toml"}},
             Case{{"self-test", "--device", "hid:1", "--enable-uncalibrated-force"},
                  2,
                  {"--enable-uncalibrated-force", "omni1394", "--device hid:1"}},
             Case{{"--remote", free, "--hid-travel", "9m"}, 2, {"--hid-travel", "10mm to 5m"}},
         }) {
        const auto outcome = peer(c.words);
        EXPECT_EQ(outcome.exit, c.exit) << c.words.back() << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "");
        expect_said(outcome.err, c.said);
    }
}

TEST(PeerDevices, WantASelfTestBeforeASessionAndSayHow)
{
    const TemporaryFolder folder;
    setenv("XDG_STATE_HOME", folder.file("state").c_str(), 1);
    const auto outcome =
        peer({"--remote", free_place(), "--device", "hdapi:Left", "--hd-library", HAPNET_FAKE_HD});
    unsetenv("XDG_STATE_HOME");
    EXPECT_EQ(outcome.exit, 3);
    expect_said(outcome.err, {"hdapi:Left: it has not passed a self-test on this machine",
                              "hapnet-peer self-test --device hdapi:Left", "--untested-device"});
}

TEST(PeerDevices, TellsThePersonWithARealDeviceWhereItIsMountedAndTheirPart)
{
    Process session{"hapnet-peer",
                    {"--remote", free_place(), "--task", "T3", "--untested-device", "--device",
                     "hdapi", "--hd-library", HAPNET_FAKE_HD, "--stats", "-"}};
    ASSERT_TRUE(session.wait_for_out("ready", 5s)) << session.err();
    session.signal(SIGTERM);
    EXPECT_EQ(session.wait_exit(5s), 0);
    expect_said(session.err(), {"never run on the physical device", "magnified 1.00 times",
                                "Task T3 is yours to play", "carry it slowly"});
    EXPECT_TRUE(json::parse(session.out().substr(session.out().find('{')))["operator"].is_null());
}

TEST(PeerDevices, ThatPaceTheLoopLeaveARecordWhoseForcesCanBeLivedThroughAgain)
{
    // As when a person takes the stylus out of its inkwell.
    setenv(fake_hd_log_variable, "/dev/null", 1);
    const std::string place = free_place();
    Peer simulated{2, free_place(), place, {"--task", "T3", "--duration", "6s"}};
    Peer paced{1,
               place,
               simulated.listen(),
               {"--task", "T3", "--duration", "6s", "--untested-device", "--device", "hdapi",
                "--hd-library", HAPNET_FAKE_HD, "--mount-offset", "-30mm,0mm,0mm", "--mount-scale",
                "1.3"}};
    unsetenv(fake_hd_log_variable);
    paced.expect_end();
    simulated.expect_end();
    expect_the_same_forces_again(paced.record());
    double most_n = 0.0;
    for (const Tick& tick : ticks_of(paced.record())) most_n = std::max(most_n, tick.force_n);
    EXPECT_GT(most_n, 0.1);
}

} // namespace hapnet::e2e
