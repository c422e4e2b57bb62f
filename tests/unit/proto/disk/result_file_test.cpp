// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/result_file.hpp"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::disk {
namespace {

class ResultFileTest : public testing::Test {
protected:
    ResultFileTest()
    {
        std::string name = (std::filesystem::temp_directory_path() / "hapnet-XXXXXX").string();
        folder = mkdtemp(name.data());
    }
    ~ResultFileTest() override { std::filesystem::remove_all(folder); }

    [[nodiscard]] static std::string text_of(const std::filesystem::path& path)
    {
        std::ifstream file{path};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    [[nodiscard]] std::size_t files() const
    {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator{folder},
                                                      std::filesystem::directory_iterator{}));
    }

    std::filesystem::path folder;
};

TEST_F(ResultFileTest, AppearsWholeAndLeavesNothingBeside)
{
    const auto path = folder / "result";
    {
        ResultFile file{path};
        EXPECT_FALSE(std::filesystem::exists(path));
        file.commit("all of it\n");
    }
    EXPECT_EQ(text_of(path), "all of it\n");
    EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, KeepsTheOldResultWhenNothingIsCommitted)
{
    const auto path = folder / "result";
    std::ofstream{path} << "old";
    {
        const ResultFile file{path};
    }
    EXPECT_EQ(text_of(path), "old");
    EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, KeepsWhatWasWrittenBeforeTheDiskWasFull)
{
    const auto path = folder / "result";
    std::signal(SIGXFSZ, SIG_IGN); // a file that is too long stands for a full disk
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 1000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    {
        ResultFile file{path};
        file.append(std::string(600, 'a'));
        EXPECT_THROW(file.append(std::string(600, 'b')), std::system_error);
        EXPECT_FALSE(std::filesystem::exists(path));
        file.keep();
    }
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(text_of(path), std::string(600, 'a')); // no part of what did not fit
    EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, RemovesWhatAKilledProcessLeftOfItsFileAndNothingElse)
{
    const pid_t child = fork();
    if (child == 0) _exit(0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const auto dead = std::to_string(child);
    const auto alive = std::to_string(getppid());
    for (const std::string& name : {"result." + dead + ".partial", "result." + alive + ".partial",
                                    "results." + dead + ".partial", "result." + dead + ".part",
                                    std::string{"result.x.partial"}}) {
        std::ofstream{folder / name} << "part";
    }
    ResultFile{folder / "result"}.commit("whole");
    EXPECT_FALSE(std::filesystem::exists(folder / ("result." + dead + ".partial")));
    EXPECT_EQ(files(), 5U);
}

TEST_F(ResultFileTest, FollowsASymbolicLinkInsteadOfReplacingIt)
{
    std::ofstream{folder / "real"} << "old";
    std::filesystem::create_symlink(folder / "real", folder / "link");
    ResultFile{folder / "link"}.commit("new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(text_of(folder / "real"), "new");
}

TEST_F(ResultFileTest, WritesToAPipeAndLeavesItAPipe)
{
    const auto path = folder / "pipe";
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    ResultFile{path}.commit("through");
    std::array<char, 16> text{};
    EXPECT_EQ(read(reader, text.data(), text.size()), 7);
    EXPECT_STREQ(text.data(), "through");
    close(reader);
    EXPECT_TRUE(std::filesystem::is_fifo(path));
}

TEST_F(ResultFileTest, RefusesAFolderAndAPlaceThatIsNotThere)
{
    EXPECT_THROW(ResultFile{folder}, std::system_error);
    EXPECT_THROW(ResultFile{folder / "missing" / "result"}, std::system_error);
}

} // namespace
} // namespace hapnet::disk
