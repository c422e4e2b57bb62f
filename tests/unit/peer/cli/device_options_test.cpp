// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/command_line.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

/// The refusal of these words, after a --remote; "" where they are accepted.
std::string refusal_of(std::vector<std::string> words)
{
    const bool is_session = words.front().starts_with("--");
    if (is_session) words.insert(words.begin(), {"--remote", "127.0.0.1:9"});
    words.insert(words.begin(), "hapnet-peer");
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    const auto line = parse_command_line(pointers);
    return line ? "" : line.error().message;
}

void expect_said(const std::string& refusal, const std::vector<std::string>& words)
{
    for (const std::string& word : words) {
        EXPECT_NE(refusal.find(word), std::string::npos) << word << " is not in: " << refusal;
    }
}

/// A file that exists as long as this object.
class Written {
public:
    explicit Written(std::string_view text)
        : path_{testing::TempDir() + "hapnet-device-options-" +
                testing::UnitTest::GetInstance()->current_test_info()->name()}
    {
        std::ofstream{path_} << text;
    }
    ~Written() { std::filesystem::remove(path_); }
    Written(const Written&) = delete;
    Written& operator=(const Written&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

TEST(DeviceOptions, OfAnotherDeviceAreRefusedNamingBoth)
{
    const Written file{"write_register_20010 = true\n"};
    struct Case {
        std::vector<std::string> option;
        std::string belongs_to;
        std::string other;
    };
    for (const Case& c : {Case{{"--falcon-firmware", file.path()}, "falcon", "hid:1"},
                          Case{{"--omni-torque", file.path()}, "omni1394", "hid:1"},
                          Case{{"--enable-uncalibrated-force"}, "omni1394", "hdapi"},
                          Case{{"--hid-force", "5N"}, "hid", "falcon"},
                          Case{{"--hd-library", "libHD.so"}, "hdapi", "sim"},
                          Case{{"--dhd-library", "libdhd.so"}, "dhd", "hdapi"},
                          Case{{"--inverse3-port", "10001"}, "inverse3", "dhd"},
                          Case{{"--operator", "firm"}, "sim", "omni1394"},
                          Case{{"--replay-loop"}, "replay:FILE", "sim:joints"}}) {
        std::vector<std::string> words = c.option;
        words.insert(words.end(), {"--device", c.other});
        expect_said(refusal_of(words), {c.option.front(), "it is for --device " + c.belongs_to,
                                        "--device " + c.other});
        words.insert(words.begin(), "self-test");
        expect_said(refusal_of(words), {c.option.front(), "--device " + c.other});
        if (c.belongs_to.starts_with("replay")) continue;
        words.back() = c.belongs_to;
        EXPECT_EQ(refusal_of(words), "");
    }
}

TEST(DeviceOptions, AnUnknownDeviceIsRefusedWithThoseThatThereAre)
{
    const std::string refusal = refusal_of({"--device", "x"});
    expect_said(refusal, {"--device: unknown device 'x': use one of sim, sim:joints, replay:FILE, ",
                          "omni1394[:SERIAL]", "hapnet-peer list-devices"});
    EXPECT_EQ(refusal.find(device::never_run), std::string::npos);
}

TEST(DeviceOptions, ADeviceByItsPopularNameIsRefusedWithItsBackend)
{
    EXPECT_EQ(refusal_of({"--device", "touch"}),
              "--device: unknown device 'touch': a Touch is opened through its vendor's library: "
              "use --device hdapi[:NAME]");
    for (const char* name : {"omni", "phantom", "omni:1"}) {
        expect_said(refusal_of({"--device", name}), {"use --device omni1394 for", "hdapi[:NAME]"});
    }
    expect_said(refusal_of({"--device", "omega"}), {"--device dhd[:SERIAL]"});
    expect_said(refusal_of({"--device", "haply"}), {"--device inverse3[:ID]"});
}

TEST(DeviceOptions, APortIsANumberThatAServiceCanHave)
{
    for (const char* port : {"0", "65536", "-1", "10001x", "", "service"}) {
        expect_said(refusal_of({"--device", "inverse3", "--inverse3-port", port}),
                    {"--inverse3-port", "from 1 to 65535"});
    }
    EXPECT_EQ(refusal_of({"--device", "inverse3:049D", "--inverse3-port", "65535"}), "");
}

TEST(DeviceOptions, ThatDoNothingForALookAroundAreNotOffered)
{
    EXPECT_EQ(refusal_of({"list-devices", "--hid-force", "5N", "--hd-library", "libHD.so"}), "");
    expect_said(refusal_of({"list-devices", "--omni-torque", "a.toml"}), {"--omni-torque"});
}

TEST(OmniTorque, IsBadUsageWhereItCannotBeRead)
{
    const auto refusal = [](const std::string& file) {
        return refusal_of({"--device", "omni1394", "--omni-torque", file});
    };
    expect_said(refusal("/no/such.toml"), {"--omni-torque", "/no/such.toml", "No such file"});
    expect_said(refusal("/tmp"), {"--omni-torque", "/tmp", "folder"});
    expect_said(refusal(""), {"--omni-torque"});
}

TEST(OmniTorque, IsBadUsageWithFileLineAndColumnOfWhatIsWrong)
{
    struct Case {
        std::string text;
        std::string place;
        std::string said;
    };
    const std::string table = "[torque_nm_per_count]\nwaist = 2e-4\nshoulder = 2e-4\n";
    for (const Case& c : {Case{"[torque_nm_per_count\nwaist = 1\n", ":1:", ""},
                          Case{"\nwrite_register_20001 = true\n", ":2:1: ", "write_register_20010"},
                          Case{table + "forearm = 2e-4\nelbow = 1.0\n", ":5:1: ", "elbow"},
                          Case{table, ":1:1: ", "forearm"},
                          Case{table + "forearm = 0.0\n", ":4:11: ", "1e-06 to 0.002"},
                          Case{table + "forearm = nan\n", ":4:11: ", "a number"},
                          Case{table + "forearm = 1.0\n", ":4:11: ", "1e-06 to 0.002"}}) {
        const Written file{c.text};
        expect_said(refusal_of({"--device", "omni1394", "--omni-torque", file.path()}),
                    {"--omni-torque: " + file.path() + c.place, c.said});
    }
}

TEST(FalconFirmware, IsBadUsageWhereItIsNoFileOrEmptyOrFarTooLarge)
{
    const auto refusal = [](const std::string& file) {
        return refusal_of({"--device", "falcon", "--falcon-firmware", file});
    };
    expect_said(refusal("/no/such.bin"), {"--falcon-firmware", "/no/such.bin", "No such file"});
    expect_said(refusal("/tmp"), {"--falcon-firmware", "/tmp", "folder"});
    const Written empty{""};
    expect_said(refusal(empty.path()), {"--falcon-firmware", empty.path(), "is empty"});
    const Written large{std::string(std::size_t{(1U << 20) + 1}, 'x')};
    expect_said(refusal(large.path()), {"--falcon-firmware", "1048577 bytes", "1048576"});
}

TEST(OtherFiles, AreBadUsageWhereTheyCannotBeRead)
{
    expect_said(refusal_of({"--device", "replay:"}), {"--device", "needs a file"});
    expect_said(refusal_of({"--device", "replay:/tmp"}), {"--device", "/tmp", "folder"});
    expect_said(refusal_of({"--operator", "/no/hand.toml"}), {"--operator", "/no/hand.toml"});
    expect_said(refusal_of({"--device", "hdapi", "--hd-library", ""}), {"--hd-library"});
    const Written hand{"preset = \"nominal\"\nhnad.mass = \"1kg\"\n"};
    const std::string named = hand.path() + ".toml";
    std::filesystem::copy_file(hand.path(), named);
    expect_said(refusal_of({"--operator", named}), {"--operator: " + named + ":2:1: "});
    std::filesystem::remove(named);
    const Written trace{"time_s,x_m,y_m,z_m\n0,0,0,0\n1,here,0,0\n"};
    expect_said(refusal_of({"--device", "replay:" + trace.path()}),
                {"--device: " + trace.path() + ":3: ", "'here'"});
}

} // namespace
} // namespace hapnet::peer
