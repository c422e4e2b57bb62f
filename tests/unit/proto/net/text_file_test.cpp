// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::net {
namespace {

namespace fs = std::filesystem;

class FolderOfFiles : public testing::Test {
protected:
    FolderOfFiles()
    {
        fs::create_directories(inside / "deeper");
        write(inside / "delays.csv", "10\n");
        write(inside / "deeper" / "more.csv", "20\n");
        write(root / "secret", "secret\n");
    }
    ~FolderOfFiles() override { fs::remove_all(root); }

    static void write(const fs::path& path, const std::string& text)
    {
        std::ofstream{path} << text;
    }

    std::string refusal_of(const std::string& name) const
    {
        const auto text = Folder{inside.string()}.text_of(name);
        return text ? "read: " + *text : text.error().message;
    }

    fs::path root = fs::temp_directory_path() / ("hapnet-folder-test-" + std::to_string(getpid()));
    fs::path inside = root / "inside";
};

TEST_F(FolderOfFiles, AreReadByTheirNamesBelowIt)
{
    const Folder folder{inside.string() + "/"};
    EXPECT_EQ(folder.text_of("delays.csv").value(), "10\n");
    EXPECT_EQ(folder.text_of("deeper/more.csv").value(), "20\n");
    EXPECT_EQ(folder.text_of("deeper/../delays.csv").value(), "10\n");
    EXPECT_EQ(folder.text_of((inside / "delays.csv").string()).value(), "10\n");
}

TEST_F(FolderOfFiles, AreNoOthers)
{
    fs::create_symlink(root / "secret", inside / "link");
    fs::create_directory_symlink(root, inside / "up");
    for (const std::string name : {"../secret", "deeper/../../secret", "link", "up/secret",
                                   "/etc/passwd", "/nowhere/at/all"}) {
        EXPECT_EQ(refusal_of(name), "cannot read " + name +
                                        ": it is not below the folder of files that may be named");
    }
    EXPECT_NE(refusal_of((root / "secret").string()).find("not below"), std::string::npos);
}

TEST_F(FolderOfFiles, MayBeLinksWithinIt)
{
    fs::create_symlink("deeper/more.csv", inside / "link");
    EXPECT_EQ(refusal_of("link"), "read: 20\n");
}

TEST_F(FolderOfFiles, AreRegularOnes)
{
    ASSERT_EQ(mkfifo((inside / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(refusal_of("pipe"), "cannot read pipe: it is not a regular file");
    EXPECT_EQ(refusal_of("deeper"), "cannot read deeper: it is a folder");
    EXPECT_EQ(refusal_of("missing"), "cannot read missing: No such file or directory");
}

TEST_F(FolderOfFiles, NeedAFolder)
{
    EXPECT_THROW(Folder{(inside / "delays.csv").string()}, std::system_error);
    EXPECT_THROW(Folder{(inside / "missing").string()}, std::system_error);
}

TEST_F(FolderOfFiles, HaveAtMost256MiB)
{
    const auto path = inside / "large";
    write(path, "");
    fs::resize_file(path, (std::uintmax_t{256} << 20) + 1);
    EXPECT_EQ(text_of_file(path.string()).error().message,
              "cannot read " + path.string() + ": it is larger than 256 MiB");
}

} // namespace
} // namespace hapnet::net
