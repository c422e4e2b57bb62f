// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Two daemons with keys, over real sockets.
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/peer.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <tuple>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// The key files of a circle of two.
class Circle {
public:
    Circle()
    {
        const auto made =
            run("hapnet-peer", {"keygen", "--peers", "2", "--out", folder_.file("k")});
        EXPECT_EQ(made.exit, 0) << made.err;
    }
    [[nodiscard]] std::string of(int id) const
    {
        return folder_.file("k/peer-" + std::to_string(id) + ".key");
    }

private:
    TemporaryFolder folder_;
};

void expect_only_sealed(const nlohmann::json& statistics)
{
    EXPECT_EQ(statistics["secure"]["agreed"], true);
    EXPECT_EQ(statistics["secure"]["handshakes"], 1);
    for (const char* trouble : {"forged", "unsealed", "unknown_key", "other_circle", "misnamed"})
        EXPECT_EQ(statistics["secure"][trouble], 0) << trouble;
    EXPECT_EQ(statistics["messages"]["malformed"], 0);
    EXPECT_GT(statistics["messages"]["states_received"], 2000);
}

/// The words behind "SECRET = " in a key file.
std::string secret_in(const std::string& file, const std::string& key)
{
    const std::string text = text_of(file);
    const auto begin = text.find(key + " = \"") + key.size() + 4;
    return text.substr(begin, text.find('"', begin) - begin);
}

/// The lines of a file that begin so.
std::vector<std::string> rows_of(const std::string& file, std::string_view begin)
{
    std::vector<std::string> rows;
    std::istringstream text{text_of(file)};
    for (std::string row; std::getline(text, row);)
        if (row.starts_with(begin)) rows.push_back(row);
    return rows;
}

} // namespace

TEST(PeerKeys, SealASessionThroughTheEmulatorThatReplaysAndIsAnalysedAsAnyOther)
{
    const Circle circle;
    Emulator emulator{{"--delay", "20ms", "--loss", "10%"}};
    Peer a{1, free_place(), emulator.a().to_text(), {"--key", circle.of(1), "--duration", "5s"}};
    Peer b{2, free_place(), emulator.b().to_text(), {"--key", circle.of(2), "--duration", "5s"}};
    EXPECT_TRUE(a.says("agreed on a key"));
    a.expect_end();
    b.expect_end();
    for (Peer* peer : {&a, &b}) {
        expect_only_sealed(peer->statistics());
        expect_the_same_forces_again(peer->record());
        for (const char* key : {"secret", "psk"}) {
            const std::string secret = secret_in(circle.of(peer == &a ? 1 : 2), key);
            EXPECT_EQ(secret.size(), 44U);
            EXPECT_EQ(text_of(peer->record()).find(secret), std::string::npos);
            EXPECT_EQ(peer->statistics().dump().find(secret), std::string::npos);
            EXPECT_EQ(peer->process().err().find(secret), std::string::npos);
        }
    }
    const auto analysis = analysis_of(a.record(), b.record());
    EXPECT_LE(analysis["settled_discrepancy_mm"].get<double>(), 0.1);
}

TEST(PeerKeys, MeetTheFatesThatTheSameSeedDealsWithoutThem)
{
    const Circle circle;
    const TemporaryFolder folder;
    std::vector<std::vector<std::string>> fates;
    for (const bool keyed : {false, true}) {
        const std::string file = folder.file(keyed ? "keyed.csv" : "plain.csv");
        const std::string place_a = free_place(), place_b = free_place();
        Emulator emulator{{"--delay", "20ms", "--jitter", "5ms", "--loss", "20%", "--seed", "7",
                           "--a", place_a, "--b", place_b, "--fates", file}};
        std::vector<std::string> options_a{"--task", "P1", "--duration", "3s"};
        std::vector<std::string> options_b = options_a;
        if (keyed) {
            options_a.insert(options_a.end(), {"--key", circle.of(1)});
            options_b.insert(options_b.end(), {"--key", circle.of(2)});
        }
        Peer a{1, place_a, emulator.a().to_text(), options_a};
        Peer b{2, place_b, emulator.b().to_text(), options_b};
        a.expect_end();
        b.expect_end();
        std::ignore = emulator.stop();
        for (const char* way : {"up,", "down,"}) fates.push_back(rows_of(file, way));
    }
    for (const std::size_t way : {0U, 1U}) {
        auto& plain = fates[way];
        auto& keyed = fates[way + 2];
        const std::size_t common = std::min(plain.size(), keyed.size());
        EXPECT_GT(common, 2000U);
        plain.resize(common);
        keyed.resize(common);
        EXPECT_EQ(plain, keyed) << way;
    }
}

TEST(PeerKeys, LeaveNoCoreDump)
{
    const Circle circle;
    Peer a{1, free_place(), free_place(), {"--key", circle.of(1)}};
    // The kernel gives the files of a process that may not be dumped to root.
    struct stat owner {};
    ASSERT_EQ(::stat(("/proc/" + std::to_string(a.process().pid()) + "/environ").c_str(), &owner),
              0);
    EXPECT_EQ(owner.st_uid, 0U);
    a.process().signal(SIGSEGV);
    EXPECT_EQ(a.process().wait_exit(20s), 128 + SIGSEGV);
}

TEST(PeerKeys, SayThatTheOtherSidePlaysWithoutOne)
{
    const Circle circle;
    const std::string place_a = free_place(), place_b = free_place();
    Peer a{1, place_a, place_b, {"--key", circle.of(1)}};
    Peer b{2, place_b, place_a, {}};
    EXPECT_TRUE(a.says("plays without a key"));
    EXPECT_TRUE(b.says("plays with a key"));
    a.stop();
    b.stop();
    EXPECT_GT(a.statistics()["secure"]["unsealed"], 2);
    EXPECT_EQ(a.statistics()["messages"]["hellos"], 0);
    EXPECT_EQ(b.statistics()["secure"], nullptr);
}

TEST(PeerKeys, OfAnotherCircleAreNotHeard)
{
    const Circle one, other;
    const std::string place_a = free_place(), place_b = free_place();
    Peer a{1, place_a, place_b, {"--key", one.of(1)}};
    Peer b{2, place_b, place_a, {"--key", other.of(2)}};
    EXPECT_TRUE(a.says("not of this circle"));
    EXPECT_TRUE(b.says("not of this circle"));
    a.stop();
    b.stop();
    EXPECT_EQ(a.statistics()["secure"]["agreed"], false);
    EXPECT_EQ(a.statistics()["messages"]["hellos"], 0);
}

TEST(PeerKeys, FollowThePeerThatIsHeardFromAnotherPlaceUnlessToldToStay)
{
    for (const bool stays : {false, true}) {
        const Circle circle;
        const std::string place_a = free_place(), place_b = free_place();
        std::vector<std::string> options{"--key", circle.of(1)};
        if (stays) options.emplace_back("--no-roam");
        Peer a{1, place_a, place_b, options};
        auto b = std::make_unique<Peer>(2, place_b, place_a,
                                        std::vector<std::string>{"--key", circle.of(2)});
        EXPECT_TRUE(a.says("session started"));
        b->kill();
        Peer moved{2, free_place(), place_a, {"--key", circle.of(2)}};
        if (stays) {
            EXPECT_TRUE(a.says("silent"));
            EXPECT_FALSE(moved.process().wait_for_err("joined the session", 1500ms));
        } else {
            EXPECT_TRUE(a.says("heard from another address"));
            EXPECT_TRUE(moved.says("joined the session"));
        }
        moved.stop_on_a_busy_machine();
        a.stop_on_a_busy_machine();
        EXPECT_EQ(a.statistics()["secure"]["roamed"] > 0, !stays);
    }
}

TEST(PeerKeys, AreRefusedWithTheCureWhenTheyDoNotFit)
{
    const Circle circle;
    const std::string key = circle.of(1);
    const auto refused = [](std::vector<std::string> options, const std::vector<std::string>& why) {
        options.insert(options.begin(), {"--remote", "127.0.0.1:9"});
        expect_refusal(run("hapnet-peer", options), 2, why);
    };
    refused({"--key", key, "--insecure"}, {"--key", "--insecure"});
    refused({"--key", key, "--id", "2"}, {"--id 2", "peer 1"});
    refused({"--no-roam"}, {"--no-roam", "--key"});
    refused({"--key", key, "--peer", "2=127.0.0.1:9"}, {"--peer", "--remote"});
    expect_refusal(run("hapnet-peer", {"--key", key, "--peer", "3=127.0.0.1:9"}), 2,
                   {"--peer", "no peer 3", "key show"});
    expect_refusal(run("hapnet-peer", {"--key", key}), 2, {"--remote is required"});
    std::filesystem::permissions(key, std::filesystem::perms::group_read,
                                 std::filesystem::perm_options::add);
    refused({"--key", key}, {key, "chmod 600"});
}

TEST(PeerKeys, AreLookedAtByTheDoctor)
{
    const Circle circle;
    const std::string key = circle.of(1);
    EXPECT_NE(run("hapnet-peer", {"doctor", "--key", key}).out.find(key + " is readable"),
              std::string::npos);
    std::filesystem::permissions(key, std::filesystem::perms::others_read,
                                 std::filesystem::perm_options::add);
    const auto outcome = run("hapnet-peer", {"doctor", "--key", key});
    EXPECT_EQ(outcome.exit, 3);
    EXPECT_NE(outcome.out.find("chmod 600 " + key), std::string::npos);
}

TEST(Keygen, MakesFilesThatShowTheSameFingerprintAndNoSecret)
{
    const Circle circle;
    std::string fingerprint;
    for (const int id : {1, 2}) {
        struct stat status {};
        ASSERT_EQ(::stat(circle.of(id).c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 0777, 0600U);
        const auto shown = run("hapnet-peer", {"key", "show", circle.of(id)});
        EXPECT_EQ(shown.exit, 0);
        const std::string last = shown.out.substr(shown.out.find("fingerprint"));
        if (id == 2) {
            EXPECT_EQ(last, fingerprint);
        }
        fingerprint = last;
        EXPECT_EQ(shown.out.find(secret_in(circle.of(id), "secret")), std::string::npos);
        EXPECT_EQ(shown.out.find(secret_in(circle.of(id), "psk")), std::string::npos);
    }
}

TEST(Keygen, ShowsControlCharactersOfTextsInAFileInsteadOfPrintingThem)
{
    const Circle circle;
    const std::string file = circle.of(1);
    std::string text = text_of(file);
    text.replace(text.find("lab"), 3, "l\\u001B]0;t\\u0007b");
    text += "endpoint = \"h\\u009B31m\"\n";
    std::ofstream{file} << text;
    const auto shown = run("hapnet-peer", {"key", "show", file});
    EXPECT_EQ(shown.exit, 0) << shown.err;
    EXPECT_NE(shown.out.find("circle l\\u001B]0;t\\u0007b\n"), std::string::npos) << shown.out;
    EXPECT_NE(shown.out.find("h\\u009B31m"), std::string::npos) << shown.out;
    const auto played = run("hapnet-peer", {"--key", file});
    EXPECT_EQ(played.exit, 2);
    EXPECT_NE(played.err.find("h\\u009B31m"), std::string::npos) << played.err;
    expect_refusal(run("hapnet-peer", {"keygen", "--own", "--id", "1", "--name", "a\x1b[2J",
                                       "--out", file + ".new"}),
                   2, {"--name", "control characters"});
}

TEST(Keygen, NeverReplacesAKey)
{
    const Circle circle;
    const std::string before = text_of(circle.of(2));
    const std::string folder = std::filesystem::path{circle.of(2)}.parent_path();
    std::filesystem::remove(circle.of(1));
    expect_refusal(run("hapnet-peer", {"keygen", "--peers", "2", "--out", folder}), 2,
                   {"peer-2.key", "--out"});
    EXPECT_FALSE(std::filesystem::exists(circle.of(1)));
    EXPECT_EQ(text_of(circle.of(2)), before);
}

TEST(Keygen, LetsTwoHostsPairByTellingEachOtherTheirPublicKeys)
{
    const TemporaryFolder folder;
    const std::vector<std::string> files{folder.file("1.key"), folder.file("2.key")};
    std::vector<std::string> adding;
    for (const int id : {1, 2}) {
        const auto made = run("hapnet-peer", {"keygen", "--own", "--id", std::to_string(id),
                                              "--out", files.at(static_cast<std::size_t>(id) - 1)});
        EXPECT_EQ(made.exit, 0) << made.err;
        adding.push_back(made.out.substr(made.out.find("key add FILE ") + 13));
    }
    for (const std::size_t host : {0U, 1U}) {
        std::vector<std::string> words{"key", "add", files[host]};
        std::istringstream rest{adding[1 - host]};
        for (std::string word; rest >> word;) words.push_back(word);
        const auto added = run("hapnet-peer", words);
        EXPECT_EQ(added.exit, 0) << added.err;
    }
    const std::string alone = run("hapnet-peer", {"key", "show", files[0]}).out;
    EXPECT_NE(alone.find("no shared key"), std::string::npos) << alone;
    const std::string place_a = free_place(), place_b = free_place();
    Peer a{1, place_a, place_b, {"--key", files[0], "--duration", "3s"}};
    Peer b{2, place_b, place_a, {"--key", files[1], "--duration", "3s"}};
    a.expect_end();
    b.expect_end();
    expect_only_sealed(a.statistics());
}

TEST(Keygen, MakesASharedKeyWhenAPeerIsAddedThatTheOtherHostTakes)
{
    const TemporaryFolder folder;
    const std::vector<std::string> files{folder.file("1.key"), folder.file("2.key")};
    const std::string shared = folder.file("shared.key");
    std::vector<std::string> publics;
    for (const std::string& file : files) {
        const std::string id = file == files[0] ? "1" : "2";
        const auto made = run("hapnet-peer", {"keygen", "--own", "--id", id, "--out", file});
        publics.push_back(made.out.substr(made.out.find("--public ") + 9, 44));
    }
    const auto add = [&](std::size_t host, const std::string& option) {
        return run("hapnet-peer", {"key", "add", files[host], "--id", std::to_string(2 - host),
                                   "--public", publics[1 - host], option, shared});
    };
    expect_refusal(add(1, "--shared"), 2, {shared}); // it is not there yet
    const auto first = add(0, "--make-shared");
    EXPECT_EQ(first.exit, 0) << first.err;
    struct stat status {};
    ASSERT_EQ(::stat(shared.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600U);
    const auto second = add(1, "--shared");
    EXPECT_EQ(second.exit, 0) << second.err;
    const auto fingerprint = [](const std::string& text) {
        return text.substr(text.find("fingerprint"));
    };
    EXPECT_EQ(fingerprint(first.out), fingerprint(second.out));
    for (const std::string& file : files) {
        EXPECT_EQ(secret_in(file, "psk"), secret_in(shared, "psk"));
        const std::string shown = run("hapnet-peer", {"key", "show", file}).out;
        EXPECT_EQ(shown.find("no shared key"), std::string::npos) << shown;
        EXPECT_EQ(shown.find(secret_in(shared, "psk")), std::string::npos);
    }
    EXPECT_EQ((first.out + second.out).find(secret_in(shared, "psk")), std::string::npos);
    expect_refusal(add(0, "--make-shared"), 2, {"--make-shared", "already"});
}

TEST(Keygen, SaysWhatItNeeds)
{
    expect_refusal(run("hapnet-peer", {"keygen"}), 2, {"--out"});
    expect_refusal(run("hapnet-peer", {"keygen", "--out", "x"}), 2, {"--peers", "--own"});
    expect_refusal(run("hapnet-peer", {"keygen", "--own", "--out", "x"}), 2, {"--id"});
    expect_refusal(run("hapnet-peer", {"keygen", "--peers", "1", "--out", "x"}), 2, {"2 to 31"});
    expect_refusal(run("hapnet-peer", {"key", "add", "x", "--id", "2"}), 2, {"--public"});
    expect_refusal(run("hapnet-peer", {"key", "add", "x", "--id", "2", "--public", "short"}), 2,
                   {"--public", "44 characters"});
    const Circle circle;
    const std::string all_ones = std::string(42, '/') + "8="; // not below 2^255 - 19
    expect_refusal(
        run("hapnet-peer", {"key", "add", circle.of(1), "--id", "2", "--public", all_ones}), 2,
        {"--public", "not valid"});
    expect_refusal(run("hapnet-peer", {"key", "show", "/no/such.key"}), 2, {"/no/such.key"});
}

} // namespace hapnet::e2e
