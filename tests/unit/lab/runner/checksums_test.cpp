// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/checksums.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace hapnet::lab::runner {
namespace {

TEST(LineSum, IsTheLastMemberOfItsObjectAndThatOfB2sum)
{
    const auto line = with_sum(R"({"key":"k","value":1.5})");
    // printf '{"key":"k","value":1.5' | b2sum -l 128
    EXPECT_EQ(line, R"({"key":"k","value":1.5,"sum":"4d0718818ea62e340f003406d124f0f7"})");
    EXPECT_TRUE(nlohmann::json::accept(line));
    EXPECT_TRUE(has_right_sum(line));
}

TEST(LineSum, IsWrongOnceAnyByteOfTheLineChangesOrIsMissing)
{
    const auto line = with_sum(R"({"key":"k","value":1.5})");
    for (std::size_t i = 0; i < line.size(); ++i) {
        auto changed = line;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        EXPECT_FALSE(has_right_sum(changed)) << changed;
        EXPECT_FALSE(has_right_sum(line.substr(0, i))) << i;
    }
    EXPECT_FALSE(has_right_sum(line + " "));
    EXPECT_FALSE(has_right_sum(R"({"key":"k","value":1.5})")) << "as version 0.2 wrote it";
}

/// A folder of results of its own.
class SummedFolder : public testing::Test {
protected:
    SummedFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "hapnet-sums-XXXXXX").string();
        folder = mkdtemp(name.data());
        std::filesystem::create_directory(folder / "replay");
        write("limits.csv", "a,b\n1,2\n");
        write("replay/base-T1.csv", "time_s\n0\n");
        write(checksums_name, checksums_of(folder, {"limits.csv", "replay/base-T1.csv"}));
    }
    SummedFolder(const SummedFolder&) = delete;
    SummedFolder& operator=(const SummedFolder&) = delete;
    ~SummedFolder() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const
    {
        std::ofstream{folder / name} << text;
    }
    [[nodiscard]] std::string complaint() const
    {
        const auto fine = verify_checksums(folder);
        return fine ? "" : fine.error().message;
    }
    void expect_complaint(const std::string& name, const std::string& words) const
    {
        const auto expected = (folder / name).string() + " " + words;
        EXPECT_EQ(complaint().substr(0, expected.size()), expected) << complaint();
    }

    std::filesystem::path folder;
};

TEST_F(SummedFolder, IsAsItsChecksumsSay)
{
    EXPECT_EQ(complaint(), "");
    write("notes.txt", "of a person");
    EXPECT_EQ(complaint(), "");
    std::filesystem::remove(folder / checksums_name);
    write("limits.csv", "a,b\n1,3\n");
    EXPECT_EQ(complaint(), "") << "there is nothing to compare with";
}

TEST_F(SummedFolder, WithAFileThatWasChangedOrIsMissingIsRefusedByItsName)
{
    write("limits.csv", "a,b\n1,3\n");
    expect_complaint("limits.csv", "was changed: its checksum is not that in B2SUMS");
    write("limits.csv", "a,b\n1,2\n");
    std::filesystem::remove(folder / "replay" / "base-T1.csv");
    expect_complaint("replay/base-T1.csv", "is missing, and B2SUMS names it");
}

TEST_F(SummedFolder, WhoseManifestNamesTheDigestOfOtherChecksumsIsRefused)
{
    std::ifstream in{folder / checksums_name};
    const std::string sums{std::istreambuf_iterator<char>{in}, {}};
    write("manifest.json", R"({"digest":")" + checksum_of(sums) + R"("})");
    EXPECT_EQ(complaint(), "");
    write("limits.csv", "a,b\n1,3\n");
    write(checksums_name, checksums_of(folder, {"limits.csv", "replay/base-T1.csv"}));
    expect_complaint("B2SUMS", "is not the one whose digest manifest.json names");
    write("manifest.json", R"({"digest":""})"); // of a run that was stopped
    EXPECT_EQ(complaint(), "");
    for (const std::string name : {"/dev/zero", "../other", "replay/../../other"}) {
        write(checksums_name, std::string(64, '0') + "  " + name + "\n");
        expect_complaint("B2SUMS", "names '" + name + "', which is not below its folder");
    }
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    write(checksums_name, std::string(64, '0') + "  pipe\n");
    expect_complaint("pipe", "is missing");
    write(checksums_name, "no sum\n");
    expect_complaint("B2SUMS", "has a line that is no checksum");
}

} // namespace
} // namespace hapnet::lab::runner
