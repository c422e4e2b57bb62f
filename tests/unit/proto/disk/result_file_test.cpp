// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/result_file.hpp"

#include "tests/support/another_user.hpp"

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
#include <vector>

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
        EXPECT_TRUE(file.keep());
        EXPECT_FALSE(file.keep());
    }
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(text_of(path), std::string(600, 'a')); // no part of the bytes that did not fit
    EXPECT_EQ(files(), 1U);
}

TEST_F(ResultFileTest, RemovesWhatAKilledProcessLeftOfItsFileAndNothingElse)
{
    const pid_t child = fork();
    if (child == 0) _exit(0);
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
    const auto dead = std::to_string(child);
    const auto alive = std::to_string(getppid());
    const std::vector<std::string> leftovers{"result." + dead + ".partial", // of version 0.2
                                             "result." + dead + ".abc012.partial"};
    const std::vector<std::string> others{"result." + alive + ".abc012.partial",
                                          "results." + dead + ".abc012.partial",
                                          "result." + dead + ".abc012.part", "result.x.partial"};
    for (const auto& names : {leftovers, others}) {
        for (const std::string& name : names) std::ofstream{folder / name} << "part";
    }
    const auto pipe = folder / ("result." + dead + ".pipe.partial"); // opening it waits for ever
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    ResultFile{folder / "result"}.commit("whole");
    for (const std::string& name : leftovers)
        EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
    EXPECT_EQ(files(), others.size() + 2);
}

TEST_F(ResultFileTest, IsWrittenUnderANameThatNobodyCanGuess)
{
    // Links that another user puts there before, under the names that a process may take.
    std::ofstream{folder / "victim"} << "old";
    const auto pid = std::to_string(getpid());
    for (const std::string& name : {"result." + pid + ".partial", "result." + pid + "..partial"})
        std::filesystem::create_symlink("victim", folder / name);
    ResultFile{folder / "result"}.commit("new");
    EXPECT_EQ(text_of(folder / "victim"), "old");
    EXPECT_EQ(text_of(folder / "result"), "new");
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "result"));
    std::string name;
    {
        const ResultFile file{folder / "other"};
        for (const auto& entry : std::filesystem::directory_iterator{folder}) {
            const auto one = entry.path().filename().string();
            if (one.starts_with("other.")) name = one;
        }
    }
    EXPECT_GT(name.size(), ("other." + pid + ".partial").size() + 10) << name;
}

TEST_F(ResultFileTest, GivesNothingToTheFileOfAnotherUserThatHadItsName)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a file of another user";
    const auto path = folder / "url";
    std::ofstream{path} << "theirs";
    ASSERT_EQ(chmod(path.c_str(), 0666), 0);
    ASSERT_EQ(chown(path.c_str(), test::another_user, test::another_user), 0);
    const int theirs = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    ResultFile{path, "", 0600}.commit("the token");
    std::array<char, 16> text{};
    EXPECT_EQ(read(theirs, text.data(), text.size()), 6);
    EXPECT_STREQ(text.data(), "theirs");
    close(theirs);
    struct stat now {};
    ASSERT_EQ(stat(path.c_str(), &now), 0);
    EXPECT_EQ(now.st_uid, geteuid());
    EXPECT_EQ(now.st_mode & 0777U, 0600U);
    EXPECT_EQ(text_of(path), "the token");
}

TEST_F(ResultFileTest, IsRefusedBeforeTheRunWhereAnotherUserDecidesWhatItIs)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make files and links of another user";
    ASSERT_EQ(chmod(folder.c_str(), 01777), 0);
    std::ofstream{folder / "victim"} << "old";
    std::filesystem::create_symlink("victim", folder / "link");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0666), 0);
    for (const char* name : {"link", "pipe"}) {
        const auto path = folder / name;
        ASSERT_EQ(lchown(path.c_str(), test::another_user, test::another_user), 0);
        try {
            const ResultFile file{path, "--stats"};
            ADD_FAILURE() << name;
        } catch (const std::system_error& error) {
            const std::string said = error.what();
            EXPECT_TRUE(said.starts_with("--stats: cannot write " + path.string() + ": ")) << said;
            EXPECT_NE(said.find("another user"), std::string::npos) << said;
        }
    }
    EXPECT_EQ(text_of(folder / "victim"), "old");
    std::ofstream{folder / "theirs"} << "old";
    ASSERT_EQ(chown((folder / "theirs").c_str(), test::another_user, test::another_user), 0);
    const auto refused = test::as_user(test::another_user + 1, [&] {
        try {
            const ResultFile file{folder / "theirs"};
            return 0;
        } catch (const std::system_error&) {
            return 1;
        }
    });
    EXPECT_EQ(refused, 1);
}

TEST_F(ResultFileTest, IsOnTheDiskBeforeItReplacesTheOld)
{
    std::ofstream{folder / "result"} << "old";
    ResultFile{folder / "result"}.commit_to_disk("new");
    EXPECT_EQ(text_of(folder / "result"), "new");
    EXPECT_EQ(files(), 1U);
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
