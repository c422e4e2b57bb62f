// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The files that a client of the control socket can make an emulator read.
#include "tests/e2e/emulator.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::e2e {

namespace {

namespace fs = std::filesystem;

struct ClientsFiles : testing::Test {
    Outcome ctl(std::vector<std::string> words)
    {
        words.insert(words.begin(), socket);
        return run("hapnet-ctl", words);
    }

    std::string written(const std::string& name, const std::string& text)
    {
        const fs::path path{folder.file(name)};
        fs::create_directories(path.parent_path());
        std::ofstream{path} << text;
        return path.string();
    }

    static std::string traced(const std::string& file)
    {
        return "both.delay = { law = \"trace\", file = \"" + file + "\" }\n";
    }

    TemporaryFolder folder;
    std::string socket = folder.file("emulator.sock");
};

} // namespace

TEST_F(ClientsFiles, AreSentAlongFromBesideTheProfile)
{
    Emulator emulator{{"--delay", "1ms", "--control", socket}};
    written("set/delays.csv", "10ms\n20ms\n");
    const auto profile = written("set/profile.toml", traced("delays.csv"));
    const auto applied = ctl({"apply", profile});
    EXPECT_EQ(applied.exit, 0) << applied.err;
    EXPECT_NE(ctl({"show"}).out.find("delays.csv"), std::string::npos);
    const auto set = ctl({"set", "up.delay",
                          "{ law = \"trace\", file = \"" + folder.file("set/delays.csv") + "\" }"});
    EXPECT_EQ(set.exit, 0) << set.err;
}

TEST_F(ClientsFiles, AreNotThoseOfTheEmulator)
{
    Emulator emulator{{"--delay", "1ms", "--control", socket}};
    const auto profile = written("profile.toml", traced("missing.csv"));
    const auto refused = ctl({"apply", profile});
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(refused.err.find("'missing.csv' was not sent"), std::string::npos) << refused.err;
    // The answer must not show whether a file exists.
    for (const std::string name : {"/etc/passwd", "/etc/shadow", "/nowhere"}) {
        const auto reply = said_by(socket, "{\"command\":\"apply\",\"profile\":\"up.delay = { "
                                           "law = \\\"trace\\\", file = \\\"" +
                                               name + "\\\" }\"}\n");
        EXPECT_NE(reply.find("'" + name + "' was not sent"), std::string::npos) << reply;
        EXPECT_EQ(reply.find("root:"), std::string::npos) << reply;
    }
}

TEST_F(ClientsFiles, AreReadBelowTheFolderThatTheEmulatorWasTold)
{
    written("shared/delays.csv", "10ms\n20ms\n");
    written("secret", "secret\n");
    Emulator emulator{{"--delay", "1ms", "--control", socket, "--files", folder.file("shared")}};
    const auto profile = written("elsewhere/profile.toml", traced("delays.csv"));
    EXPECT_EQ(ctl({"apply", profile}).exit, 0);
    const auto out = ctl({"apply", written("elsewhere/out.toml", traced("../secret"))});
    EXPECT_EQ(out.exit, 2);
}

TEST_F(ClientsFiles, NeedAFolderThatExistsAndASocket)
{
    const auto without = run("hapnet-emulator", {"--listen-a", "0", "--listen-b", "0", "--delay",
                                                 "1ms", "--files", folder.file("none")});
    EXPECT_EQ(without.exit, 2);
    EXPECT_NE(without.err.find("--control SOCKET"), std::string::npos) << without.err;
    const auto missing =
        run("hapnet-emulator", {"--listen-a", "0", "--listen-b", "0", "--delay", "1ms", "--control",
                                socket, "--files", folder.file("none")});
    EXPECT_NE(missing.exit, 0);
    EXPECT_NE(missing.err.find(folder.file("none")), std::string::npos) << missing.err;
}

} // namespace hapnet::e2e
