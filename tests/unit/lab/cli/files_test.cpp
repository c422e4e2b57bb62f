// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/files.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace hapnet::lab {
namespace {

using Json = nlohmann::ordered_json;

/// The files of one session, as the daemons write them.
class FilesOfASession : public testing::Test {
protected:
    FilesOfASession()
    {
        std::string name =
            (std::filesystem::temp_directory_path() / "hapnet-session-XXXXXX").string();
        folder = mkdtemp(name.data());
        write("analysis.json", {{"valid", true}, {"invalid_because", Json::array()}});
        const Json way{{"received", 5}, {"dropped", {{"random_loss", 1}}}};
        write("emulator.json",
              {{"valid", true}, {"invalid_because", Json::array()}, {"up", way}, {"down", way}});
        const Json peer{{"algorithm", "base"}, {"task", "T3"}, {"others", {{{"id", 2}}}}};
        write("peer-1.json", peer);
        write("peer-2.json", peer);
    }
    FilesOfASession(const FilesOfASession&) = delete;
    FilesOfASession& operator=(const FilesOfASession&) = delete;
    ~FilesOfASession() override { std::filesystem::remove_all(folder); }

    void write(const std::string& name, const Json& json) const
    {
        std::ofstream{folder / name} << json;
    }
    [[nodiscard]] Json read(const std::string& name) const
    {
        return Json::parse(std::ifstream{folder / name});
    }
    [[nodiscard]] std::string refusal() const
    {
        const auto files = read_session_files(folder.string());
        return files ? "" : files.error().message;
    }

    std::filesystem::path folder;
};

TEST_F(FilesOfASession, AreReadTogether)
{
    const auto files = read_session_files(folder.string());
    ASSERT_TRUE(files) << files.error().message;
    EXPECT_EQ(files->others.size(), 1U);
    EXPECT_TRUE(files->invalid_because().empty());
}

TEST_F(FilesOfASession, AreRefusedByTheNameOfTheFileWithAValueOfAnotherType)
{
    const std::vector<std::tuple<const char*, const char*, Json>> wrong{
        {"analysis.json", "invalid_because", 5},
        {"emulator.json", "valid", "yes"},
        {"emulator.json", "invalid_because", "late"},
        {"emulator.json", "up", 5},
        {"emulator.json", "up", Json{{"dropped", 5}}},
        {"emulator.json", "down", Json{{"dropped", Json{{"random_loss", "many"}}}}},
        {"peer-1.json", "algorithm", 5},
        {"peer-1.json", "task", Json::array()},
        {"peer-1.json", "others", 2},
        {"peer-1.json", "others", Json::array({2})},
        {"peer-2.json", "task", 5}};
    for (const auto& [file, key, value] : wrong) {
        const Json before = read(file);
        Json other = before;
        other[key] = value;
        write(file, other);
        const auto expected = (folder / file).string() + ": '" + key + "' is not ";
        EXPECT_EQ(refusal().substr(0, expected.size()), expected) << refusal();
        write(file, before);
    }
    EXPECT_EQ(refusal(), "");
}

TEST(CreateFolder, LeavesTheOneWhereItRuns) { EXPECT_NO_THROW(create_folder("")); }

} // namespace
} // namespace hapnet::lab
