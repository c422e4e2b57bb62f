// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/keys/files.hpp"

#include "proto/secure/keys/draw.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::secure::keys {

namespace {

class KeyFiles : public testing::Test {
protected:
    KeyFiles()
    {
        std::string name = (std::filesystem::temp_directory_path() / "hapnet-keys-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        Entropy entropy{draw()};
        file_ = std::move(make_circle("lab", 2, entropy).front());
    }
    KeyFiles(const KeyFiles&) = delete;
    KeyFiles& operator=(const KeyFiles&) = delete;
    ~KeyFiles() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }
    static std::string complaint_about(const std::string& file)
    {
        const auto read = read_key_file(file);
        return read ? "" : read.error().message;
    }

    std::filesystem::path folder_;
    KeyFile file_;
};

} // namespace

TEST_F(KeyFiles, AreWrittenForTheirOwnerAloneAndReadBack)
{
    ::umask(0);
    write_key_file(path("peer-1.key"), file_);
    struct stat status {};
    ASSERT_EQ(::stat(path("peer-1.key").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, 0600U);
    const auto again = read_key_file(path("peer-1.key"));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(print_key_file(*again), print_key_file(file_));
}

TEST_F(KeyFiles, AreNotReplacedUnlessThatIsWanted)
{
    write_key_file(path("peer-1.key"), file_);
    EXPECT_THROW(write_key_file(path("peer-1.key"), file_), std::system_error);
    file_.name = "other";
    replace_key_file(path("peer-1.key"), file_);
    EXPECT_EQ(read_key_file(path("peer-1.key"))->name, "other");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_},
                            std::filesystem::directory_iterator{}),
              1);
}

TEST_F(KeyFiles, ThatOthersMayReadAreRefusedWithTheCommandThatMendsIt)
{
    const std::string file = path("peer-1.key");
    write_key_file(file, file_);
    for (const mode_t mode : {0640U, 0604U, 0620U, 0666U}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        EXPECT_EQ(complaint_about(file),
                  file + ": others may use this key file; run: chmod 600 " + file);
    }
    ASSERT_EQ(::chmod(file.c_str(), 0400), 0);
    EXPECT_EQ(complaint_about(file), "");
}

TEST_F(KeyFiles, AreRegularFilesOfAReasonableSize)
{
    write_key_file(path("peer-1.key"), file_);
    std::filesystem::create_symlink(path("peer-1.key"), path("link.key"));
    EXPECT_EQ(complaint_about(path("link.key")),
              "cannot read " + path("link.key") + ": it is a symbolic link; name the file itself");
    EXPECT_EQ(complaint_about(folder_.string()),
              folder_.string() + ": a key file is a regular file");
    ASSERT_EQ(::mkfifo(path("fifo.key").c_str(), 0600), 0);
    EXPECT_EQ(complaint_about(path("fifo.key")),
              path("fifo.key") + ": a key file is a regular file");
    std::ofstream{path("long.key")} << std::string(70'000, '#');
    std::filesystem::permissions(path("long.key"), std::filesystem::perms::owner_read);
    EXPECT_EQ(complaint_about(path("long.key")), path("long.key") + ": larger than 64 KiB");
    EXPECT_EQ(complaint_about(path("none.key")),
              "cannot read " + path("none.key") + ": No such file or directory");
}

TEST(Draw, NeverGivesTheSameTwice) { EXPECT_FALSE(are_equal(draw().bytes(), draw().bytes())); }

} // namespace hapnet::secure::keys
