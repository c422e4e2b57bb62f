// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/place.hpp"

#include "proto/disk/create.hpp"
#include "tests/support/another_user.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace hapnet::disk {
namespace {

namespace fs = std::filesystem;

/// A folder for each test, with files that another user may have put into it.
class PlaceTest : public testing::Test {
protected:
    PlaceTest()
    {
        std::string name = (fs::temp_directory_path() / "hapnet-place-XXXXXX").string();
        folder = mkdtemp(name.data());
        fs::permissions(folder, fs::perms::all);
        fs::create_directory(folder / "own");
        std::ofstream{folder / "own" / "file"} << "old";
    }
    PlaceTest(const PlaceTest&) = delete;
    PlaceTest& operator=(const PlaceTest&) = delete;
    ~PlaceTest() override { fs::remove_all(folder); }

    static std::error_code refusal(const std::string& path)
    {
        const auto place = Place::find(path);
        return place ? std::error_code{} : place.error();
    }
    static std::error_code refusal_to_write(const std::string& path, mode_t mode = 0644)
    {
        const auto file = open_to_write(path, O_WRONLY | O_NONBLOCK, mode);
        return file ? std::error_code{} : file.error();
    }
    static void give_away(const fs::path& path)
    {
        ASSERT_EQ(lchown(path.c_str(), test::another_user, test::another_user), 0);
    }
    [[nodiscard]] static std::string text_of(const fs::path& path)
    {
        std::ifstream file{path};
        return {std::istreambuf_iterator<char>{file}, {}};
    }

    fs::path folder;
};

std::error_code system_error(int number) { return {number, std::generic_category()}; }

TEST_F(PlaceTest, IsWhereOwnLinksLead)
{
    fs::create_directory_symlink("own", folder / "way");
    fs::create_symlink("way/file", folder / "link");
    for (const char* name : {"link", "way/file", "own/../link", "way//./file"}) {
        const auto place = Place::find((folder / name).string());
        ASSERT_TRUE(place) << name << ": " << place.error().message();
        EXPECT_EQ(place->name(), "file");
        EXPECT_TRUE(place->is_regular());
        struct stat own {};
        struct stat found {};
        ASSERT_EQ(stat((folder / "own").c_str(), &own), 0);
        ASSERT_EQ(fstat(place->folder(), &found), 0);
        EXPECT_EQ(found.st_ino, own.st_ino) << name;
    }
}

TEST_F(PlaceTest, MayBeFreeAlsoAtTheEndOfALink)
{
    fs::create_symlink("own/new", folder / "link");
    const auto place = Place::find((folder / "link").string());
    ASSERT_TRUE(place);
    EXPECT_EQ(place->name(), "new");
    EXPECT_FALSE(place->found());
    const auto kept = Place::find((folder / "link").string(), Place::LastLink::kept);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->name(), "link");
    EXPECT_EQ(create(*kept, O_WRONLY, 0600).error(), system_error(EEXIST));
    EXPECT_FALSE(fs::exists(folder / "own" / "new"));
}

TEST_F(PlaceTest, IsRefusedWhereThereIsNone)
{
    EXPECT_EQ(refusal(""), system_error(ENOENT));
    EXPECT_EQ(refusal((folder / "none" / "file").string()), system_error(ENOENT));
    EXPECT_EQ(refusal((folder / "own" / "file" / "below").string()), system_error(ENOTDIR));
    EXPECT_EQ(refusal(folder.string() + "/own/"), system_error(EISDIR));
    EXPECT_EQ(refusal_to_write((folder / "own").string()), system_error(EISDIR));
    fs::create_symlink("/", folder / "root");
    EXPECT_EQ(refusal((folder / "root").string()), system_error(EISDIR));
    fs::create_symlink("round", folder / "round");
    EXPECT_EQ(refusal((folder / "round").string()), system_error(ELOOP));
}

TEST_F(PlaceTest, OfAPipeThatAProcessHasOpenIsTheLinkOfTheKernel)
{
    std::array<int, 2> pipe{};
    ASSERT_EQ(pipe2(pipe.data(), O_CLOEXEC), 0);
    const auto place = Place::find("/proc/self/fd/" + std::to_string(pipe[1]));
    ASSERT_TRUE(place) << place.error().message();
    EXPECT_TRUE(place->is_open_file());
    const auto file = open_to_write(*place, O_WRONLY, 0644);
    ASSERT_TRUE(file) << file.error().message();
    EXPECT_FALSE(write_all(file->number(), "through").error);
    std::array<char, 8> text{};
    EXPECT_EQ(read(pipe[0], text.data(), text.size()), 7);
    close(pipe[0]);
    close(pipe[1]);
}

TEST_F(PlaceTest, OfAnOpenFileIsThatFileByItsName)
{
    const int own = open((folder / "own" / "file").c_str(), O_WRONLY | O_CLOEXEC);
    const auto place = Place::find("/proc/self/fd/" + std::to_string(own));
    close(own);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->name(), "file");
    EXPECT_FALSE(place->is_open_file());
}

TEST_F(PlaceTest, IsRefusedWhereALinkOfAnotherUserLeads)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a link of another user";
    fs::create_symlink("own/file", folder / "link");
    fs::create_symlink("own/new", folder / "free");
    fs::create_directory_symlink("own", folder / "way");
    for (const char* name : {"link", "free", "way"}) give_away(folder / name);
    for (const mode_t mode : {01777U, 0777U, 0755U}) {
        ASSERT_EQ(chmod(folder.c_str(), mode), 0);
        for (const char* name : {"link", "free", "way/file"}) {
            EXPECT_EQ(refusal((folder / name).string()), error_of(Refusal::link_of_another_user))
                << name;
        }
    }
    EXPECT_EQ(text_of(folder / "own" / "file"), "old");
    EXPECT_FALSE(fs::exists(folder / "own" / "new"));
}

TEST_F(PlaceTest, IsWhereTheLinksOfRootAndOfTheOwnerOfTheirFolderLead)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a link of another user";
    fs::create_symlink("own/file", folder / "of-root");
    fs::create_symlink("own/file", folder / "of-owner");
    give_away(folder / "of-owner");
    give_away(folder);
    for (const char* name : {"of-root", "of-owner"})
        EXPECT_FALSE(refusal((folder / name).string()));
    const auto as_a_third = [&] {
        return test::as_user(test::another_user + 1, [&] {
            return refusal((folder / "of-root").string()) || refusal((folder / "of-owner").string())
                       ? 1
                       : 0;
        });
    };
    EXPECT_EQ(as_a_third(), 0);
}

TEST_F(PlaceTest, OfAFileOrAPipeOfAnotherUserIsNotWrittenTo)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a file of another user";
    std::ofstream{folder / "theirs"} << "old";
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0666), 0);
    const int reader = open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    for (const char* name : {"theirs", "pipe"}) {
        EXPECT_FALSE(refusal_to_write((folder / name).string())) << name;
        give_away(folder / name);
        EXPECT_EQ(refusal_to_write((folder / name).string()),
                  error_of(Refusal::file_of_another_user))
            << name;
    }
    give_away(folder); // whoever writes into their folder may write into their file, but no secret
    for (const char* name : {"theirs", "pipe"}) {
        EXPECT_FALSE(refusal_to_write((folder / name).string())) << name;
        EXPECT_EQ(refusal_to_write((folder / name).string(), 0600),
                  error_of(Refusal::file_of_another_user))
            << name;
    }
    close(reader);
}

TEST_F(PlaceTest, OfAFileWithAnotherNameBesidesIsNotWrittenTo)
{
    fs::create_hard_link(folder / "own" / "file", folder / "name");
    EXPECT_EQ(refusal_to_write((folder / "name").string()),
              error_of(Refusal::file_with_several_names));
    fs::remove(folder / "name");
    EXPECT_FALSE(refusal_to_write((folder / "own" / "file").string()));
}

TEST_F(PlaceTest, IsNotReplacedWhereTheStickyBitKeepsTheFileOfAnotherUser)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a file of another user";
    std::ofstream{folder / "theirs"} << "old";
    give_away(folder / "theirs");
    const auto replaced_by_a_third = [&] {
        return test::as_user(test::another_user + 1, [&] {
            const auto place = Place::find((folder / "theirs").string());
            if (!place) return 2;
            return place->why_not_replaced() == error_of(Refusal::file_of_another_user) ? 1 : 0;
        });
    };
    ASSERT_EQ(chmod(folder.c_str(), 0777), 0);
    EXPECT_EQ(replaced_by_a_third(), 0);
    ASSERT_EQ(chmod(folder.c_str(), 01777), 0);
    EXPECT_EQ(replaced_by_a_third(), 1);
}

TEST_F(PlaceTest, HasRoomForAFileWithoutAName)
{
    const auto place = Place::find((folder / "own" / "result").string());
    ASSERT_TRUE(place);
    const auto file = create_nameless(*place);
    ASSERT_TRUE(file);
    EXPECT_FALSE(write_all(file->number(), "rows").error);
    EXPECT_EQ(std::distance(fs::directory_iterator{folder / "own"}, fs::directory_iterator{}), 1);
    EXPECT_NE(random_letters(), random_letters());
}

TEST(Refusals, SayWhatToDo)
{
    for (const Refusal refusal : {Refusal::link_of_another_user, Refusal::file_of_another_user,
                                  Refusal::file_with_several_names}) {
        EXPECT_EQ(error_of(refusal), std::errc::permission_denied);
        EXPECT_NE(error_of(refusal).message().find("choose another"), std::string::npos);
    }
}

} // namespace
} // namespace hapnet::disk
