// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Two commands with the emulator on the wire between them. The commands are the emulator's own
// probe, and the shell.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// The path of the program under test, as the commands call it.
std::string emulator_path() { return std::string{HAPNET_BIN_DIR} + "/hapnet-emulator"; }

const std::vector<std::string> answering{"sh", "-c",
                                         emulator_path() + " probe --answer '[::]:7002'"};

std::string probing(const std::string& where, const std::string& options)
{
    return "out=$(" + emulator_path() + " probe " + where + ":7002 --json " + options +
           "); code=$?; echo \"$out\"; exit $code";
}

Outcome run_between(std::vector<std::string> options, const std::string& a,
                    const std::vector<std::string>& b = answering)
{
    options.insert(options.begin(), "between");
    options.insert(options.end(), {"--", "sh", "-c", a, "---"});
    options.insert(options.end(), b.begin(), b.end());
    return run("hapnet-emulator", options, 60s);
}

} // namespace

class EmulatorBetween : public testing::Test {
protected:
    void SetUp() override
    {
        const auto trial = run("hapnet-emulator", {"between", "--", "true", "---", "true"});
        const bool lacks_ipv6 = trial.err.find("the address fd00::") != std::string::npos;
        const char* const reason =
            lacks_ipv6 ? "no IPv6 here: " : "no networks of one's own here: ";
        if (trial.exit == 3) GTEST_SKIP() << reason << trial.err;
    }
};

TEST_F(EmulatorBetween, DelaysBothWaysAndNeverLess)
{
    const TemporaryFolder folder;
    const auto stats = folder.file("run.json");
    const auto outcome =
        run_between({"--up.delay", "40ms", "--down.delay", "15ms", "--stats", stats},
                    probing("b", "--count 20 --rate 100"));
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    const auto probe = nlohmann::json::parse(outcome.out.substr(outcome.out.find("{\n")));
    EXPECT_EQ(probe["answered"], 20);
    EXPECT_GE(probe["there"]["delay_ms"]["min"], 40.0);
    EXPECT_GE(probe["back"]["delay_ms"]["min"], 15.0);
    const auto statistics = nlohmann::json::parse(text_of(stats));
    expect_identity(statistics["up"]);
    expect_identity(statistics["down"]);
    EXPECT_EQ(statistics["command"], "between");
    EXPECT_EQ(statistics["frames"]["a"]["oversized"], 0);
    EXPECT_GE(statistics["frames"]["a"]["undisturbed"], 1); // ARP
    EXPECT_GE(statistics["up"]["received"], 20);
    EXPECT_GE(statistics["up"]["bytes_in"], 20 * 136);
}

/// The kernels of both networks send a few packets before any command does. Command B listens on no
/// port, so the emulator looks for its listener meanwhile, for a second. p99 of so few packets is
/// their maximum: without SCHED_FIFO one of twenty runs on a quiet machine had a packet that was
/// too late, so there one run of three has to be valid. As root the first one has to be.
TEST_F(EmulatorBetween, IsValidFromItsFirstPacketOn)
{
    const TemporaryFolder folder;
    const auto stats = folder.file("run.json");
    std::string said;
    bool was_valid = false;
    const int tries = geteuid() == 0 ? 1 : 3;
    for (int times = 0; times < tries && !was_valid; ++times) {
        const auto outcome =
            run_between({"--delay", "40ms", "--require", "valid==true", "--stats", stats}, "true",
                        {"sleep", "infinity"});
        was_valid = outcome.exit == 0;
        said += outcome.err;
        const auto statistics = nlohmann::json::parse(text_of(stats));
        EXPECT_GE(statistics["duration_s"], 1.0) << statistics;
    }
    EXPECT_TRUE(was_valid) << said;
}

TEST_F(EmulatorBetween, CarriesIpv6)
{
    const auto outcome = run_between({"--delay", "5ms"}, probing("[$HAPNET_B6]", "--count 3"));
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\"answered\": 3"), std::string::npos);
}

TEST_F(EmulatorBetween, CountsAnswersThatNoProgramListens)
{
    const TemporaryFolder folder;
    const auto stats = folder.file("run.json");
    const auto outcome =
        run_between({"--stats", stats}, probing("b", "--count 5 --rate 50"), {"sleep", "infinity"});
    EXPECT_NE(outcome.exit, 0); // the probe has no answer
    const auto statistics = nlohmann::json::parse(text_of(stats));
    EXPECT_GE(statistics["up"]["unreachable"], 5);
    EXPECT_EQ(statistics["down"]["unreachable"], 0);
    EXPECT_NE(outcome.err.find("answers that no program listens"), std::string::npos)
        << outcome.err;
}

TEST_F(EmulatorBetween, CarriesMulticastAndBroadcastOfIpv4)
{
    for (const std::string where : {"239.255.0.7", "255.255.255.255", "10.0.0.255"}) {
        const auto outcome = run_between(
            {"--delay", "5ms"}, std::string{HAPNET_GROUP_HOST} + " send " + where + ":7400 10",
            {HAPNET_GROUP_HOST, "answer", "7400", "239.255.0.7"});
        EXPECT_EQ(outcome.exit, 0) << where << outcome.err;
        EXPECT_NE(outcome.out.find("10 of 10 answered"), std::string::npos) << where << outcome.out;
    }
}

TEST_F(EmulatorBetween, TellsTheCommandsWhereTheyAre)
{
    const auto outcome = run_between(
        {}, "getent ahostsv4 a; getent ahostsv4 b; getent ahostsv6 b6; echo $HAPNET_A $HAPNET_B",
        {"sleep", "infinity"});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    for (const char* words : {"10.0.0.1 ", "10.0.0.2 ", "fd00::2 ", "10.0.0.1 10.0.0.2"}) {
        EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
    }
}

TEST_F(EmulatorBetween, GivesACommandNamesOfItsOwnAndOneWithTwoAddressesIsTold)
{
    const auto outcome =
        run_between({},
                    "printf '::1 twin\\n127.0.0.1 twin\\n' >/etc/hosts && exec " + emulator_path() +
                        " --listen 127.0.0.1:0 --upstream twin:7001 "
                        "--duration 200ms",
                    {"sleep", "infinity"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("--upstream twin:7001 has 2 addresses, [::1]:7001 and "
                               "127.0.0.1:7001: datagrams go to the first"),
              std::string::npos)
        << outcome.err;
}

TEST_F(EmulatorBetween, EndsAsCommandAEndsAndEndsB)
{
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run_between({}, "exit 7", {"sleep", "infinity"}).exit, 7);
    EXPECT_EQ(run_between({}, "kill -KILL $$", {"sleep", "infinity"}).exit, 128 + SIGKILL);
    // One command does not heed SIGTERM, and neither does its child.
    EXPECT_EQ(run_between({}, "true", {"sh", "-c", "trap '' TERM; sleep 1000 & wait; wait"}).exit,
              0);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 55s);
}

TEST_F(EmulatorBetween, IsCheckedAndEndedByAClientOfItsControl)
{
    const TemporaryFolder folder;
    const auto stats = folder.file("run.json");
    const auto socket = folder.file("s");
    const auto ctl = std::string{HAPNET_BIN_DIR} + "/hapnet-ctl " + socket;
    const auto ended = run_between({"--control", socket, "--stats", stats},
                                   ctl + " set up.delay 7ms && " + ctl + " stop && sleep 1000",
                                   {"sleep", "infinity"});
    EXPECT_EQ(ended.exit, 128 + SIGTERM) << ended.err;
    const auto statistics = nlohmann::json::parse(text_of(stats));
    EXPECT_EQ(statistics["generation"], 2);
    EXPECT_EQ(statistics["changes"][0]["settings"], (nlohmann::json{{"up.delay", "7ms"}}));
    EXPECT_EQ(statistics["configuration_at_start"]["up"], nlohmann::json::object());
    EXPECT_EQ(statistics["configuration_at_end"]["up"]["delay"], "7ms");
    const auto checked =
        run_between({"--require", "up.received>=1000000"}, "true", {"sleep", "infinity"});
    EXPECT_EQ(checked.exit, 1);
    EXPECT_NE(checked.err.find("NOT MET: up.received>=1000000"), std::string::npos) << checked.err;
    EXPECT_EQ(run_between({"--require", "up.recieved>1"}, "true", {"sleep", "infinity"}).exit, 2);
}

TEST_F(EmulatorBetween, LosesTheSamePacketsAsEverForASeed)
{
    const TemporaryFolder folder;
    const auto fates_of = [&](const char* name) {
        const auto outcome =
            run_between({"--up.loss", "20%", "--seed", "5", "--fates", folder.file(name)},
                        probing("b", "--count 40 --rate 400"));
        EXPECT_EQ(outcome.exit, 0) << outcome.err;
        std::vector<std::string> up;
        const auto text = text_of(folder.file(name));
        for (std::size_t at = 0; at < text.size();) {
            const auto end = text.find('\n', at);
            const auto line = text.substr(at, end - at);
            if (line.starts_with("up,")) up.push_back(line);
            at = end + 1;
        }
        return up;
    };
    auto first = fates_of("first.csv");
    auto second = fates_of("second.csv");
    ASSERT_GE(std::min(first.size(), second.size()), 40U);
    first.resize(40);
    second.resize(40);
    EXPECT_EQ(first, second);
}

/// The result for a sender of 100 datagrams of 1000 bytes, one per millisecond, behind 1 Mbit/s:
/// the marks with which they arrived, and the emulator's counts.
struct Marks {
    int not_ect = 0;
    int ect1 = 0;
    int ect0 = 0;
    int ce = 0;
    nlohmann::json up{};
};

Marks marks_behind(const std::string& queue, int traffic_class)
{
    const TemporaryFolder folder;
    const auto stats = folder.file("run.json");
    const std::string host = HAPNET_MARKS_HOST;
    const auto outcome = run_between(
        {"--set", "up.rate={ limit = \"1Mbit/s\", queue = \"1MiB\" }", "--set", "up.queue=" + queue,
         "--stats", stats},
        host + " send b:7003 " + std::to_string(traffic_class) + " 100", {host, "tell", "7003"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    Marks marks;
    const auto line = outcome.out.find("not-ect=");
    EXPECT_NE(line, std::string::npos) << outcome.out << outcome.err;
    if (line == std::string::npos) return marks;
    EXPECT_EQ(std::sscanf(outcome.out.c_str() + line, "not-ect=%d ect1=%d ect0=%d ce=%d",
                          &marks.not_ect, &marks.ect1, &marks.ect0, &marks.ce),
              4);
    marks.up = nlohmann::json::parse(text_of(stats))["up"];
    return marks;
}

TEST_F(EmulatorBetween, MarksWhatHasWaitedLongerThanAStepAndTheReceiverReadsIt)
{
    const auto marks = marks_behind("{ law = \"drop-tail\", ecn_threshold = \"20ms\" }", 2);
    // Each takes 8.2 ms or more on the line: at most three wait 20 ms or less.
    EXPECT_GE(marks.ce, 90);
    EXPECT_EQ(marks.ce + marks.ect0, 100);
    EXPECT_EQ(marks.up["ce_marked"], marks.ce);
    EXPECT_EQ(marks.up["ce_out"], marks.ce);
    EXPECT_EQ(marks.up["ce_in"], 0);
}

TEST_F(EmulatorBetween, MarksByCodelWhereItWouldDropAndDropsWhatIsNotEcnCapable)
{
    const std::string codel = "{ law = \"codel\", target = \"1ms\", interval = \"20ms\" }";
    const auto able = marks_behind(codel, 1); // ECT(1)
    EXPECT_GE(able.ce, 3);
    EXPECT_EQ(able.ce + able.ect1, 100);
    EXPECT_EQ(able.up["ce_marked"], able.ce);
    const auto deaf = marks_behind(codel, 0);
    EXPECT_EQ(deaf.ce, 0);
    EXPECT_LE(deaf.not_ect, 97);
    // The kernels' own packets (router solicitations, at random moments) wait in the same queue.
    const int others = deaf.up["received"].get<int>() - 100;
    const int dropped = deaf.up["dropped"]["rate_queue_law"];
    EXPECT_GE(dropped, 100 - deaf.not_ect);
    EXPECT_LE(dropped, 100 - deaf.not_ect + others);
    EXPECT_EQ(deaf.up["ce_marked"], 0);
}

TEST_F(EmulatorBetween, ReadsAnMtuAsTheSizeOfAnIpPacket)
{
    const auto with_size = [](const std::string& size) {
        return run_between({"--mtu", "600B"}, probing("b", "--count 2 --wait 100ms --size " + size))
            .exit;
    };
    EXPECT_EQ(with_size("572"), 0); // and 28 bytes of IP and UDP
    EXPECT_EQ(with_size("573"), 1);
}

TEST_F(EmulatorBetween, LeavesArpUndisturbedUnlessItIsToldNotTo)
{
    EXPECT_EQ(
        run_between({"--loss", "100%", "--all-frames"}, "ip neigh show dev eth0 >/dev/null 2>&1; " +
                                                            probing("b", "--count 2 --wait 100ms"))
            .exit,
        1);
    const auto outcome =
        run_between({"--loss", "100%", "--stats", "-"}, probing("b", "--count 2 --wait 100ms"));
    EXPECT_EQ(outcome.exit, 1);
    const auto statistics = nlohmann::json::parse(
        outcome.out.substr(outcome.out.find("{\n  \"program\": \"hapnet-emulator\",\n  \"version\"",
                                            outcome.out.find("lost_on_unknown_way"))));
    EXPECT_GE(statistics["frames"]["b"]["undisturbed"], 1); // its answer
    EXPECT_EQ(statistics["up"]["delivered"], 0);
}

TEST_F(EmulatorBetween, LeavesTheChecksumsOfDamagedPacketsWrong)
{
    const auto damaged =
        run_between({"--up.corrupt", "100%"}, probing("b", "--count 5 --rate 50 --wait 100ms"));
    EXPECT_EQ(damaged.exit, 1) << damaged.out;
    EXPECT_NE(damaged.err.find("up   (A to B)"), std::string::npos);
}

TEST_F(EmulatorBetween, StopsBothCommandsWhenItIsInterrupted)
{
    Process process{
        "hapnet-emulator",
        {"between", "--", "sh", "-c", "echo A; exec sleep 1000", "---", "sleep", "1000"}};
    ASSERT_TRUE(process.wait_for_out("A", 20s)) << process.err();
    process.signal(SIGINT);
    EXPECT_EQ(process.wait_exit(20s), 128 + SIGINT);
    EXPECT_NE(process.err().find("down (B to A)"), std::string::npos);
}

TEST_F(EmulatorBetween, SaysWhenThereIsNoSuchCommand)
{
    expect_refusal(run("hapnet-emulator", {"between", "--", "true", "---", "/no/such/command"}), 3,
                   {"/no/such/command", "spelling"});
}

/// The kernel gives no user namespace to a process with another root folder.
TEST(EmulatorBetweenUsage, NamesTheCureWhereUserNamespacesAreForbidden)
{
    if (geteuid() != 0) GTEST_SKIP() << "needs root to become a user who may do less";
    // NOLINTNEXTLINE(cert-env33-c): its words are ours
    if (std::system("unshare --mount chroot --userspec=65534:65534 / true 2>/dev/null") != 0) {
        GTEST_SKIP() << "needs a mount namespace, and to become a user who may do less";
    }
    const TemporaryFolder folder;
    const std::string all = folder.file("all");
    const std::string script = "mount --rbind / " + all +
                               " && exec chroot --userspec=65534:65534 " + all + " " +
                               emulator_path() + " between -- true --- true";
    ASSERT_EQ(mkdir(all.c_str(), 0755), 0);
    const auto command = "unshare --mount sh -c '" + script + "' 2>&1; echo \"exit $?\"";
    FILE* pipe = popen(command.c_str(), "r"); // NOLINT(cert-env33-c): its words are ours
    ASSERT_NE(pipe, nullptr);
    std::string said(4096, '\0');
    said.resize(fread(said.data(), 1, said.size(), pipe));
    pclose(pipe);
    rmdir(all.c_str());
    EXPECT_NE(said.find("cannot make a user namespace"), std::string::npos) << said;
    EXPECT_NE(said.find("max_user_namespaces"), std::string::npos) << said;
    EXPECT_NE(said.find("exit 3"), std::string::npos) << said;
}

TEST(EmulatorBetweenUsage, RefusesWhatIsNotTwoCommands)
{
    expect_refusal(run("hapnet-emulator", {"between"}), 2, {"two commands", "---"});
    expect_refusal(run("hapnet-emulator", {"between", "--", "true"}), 2, {"two commands"});
    expect_refusal(run("hapnet-emulator", {"between", "--", "true", "---"}), 2, {"two commands"});
    expect_refusal(
        run("hapnet-emulator", {"between", "--listen-a", ":1", "--", "true", "---", "true"}), 2,
        {"--listen-a"});
}

} // namespace hapnet::e2e
