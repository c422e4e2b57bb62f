// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/private_file.hpp"

#include "tests/support/another_user.hpp"

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>
#include <vector>

namespace hapnet::disk {
namespace {

constexpr PrivateKind kind{.name = "key file", .bytes_max = 1024};

/// An entry of an access control list (acl(5)).
struct Entry {
    std::uint16_t tag = 0;
    std::uint16_t permissions = 0;
    std::uint32_t id = ~0U;
};
constexpr Entry owner(std::uint16_t permissions) { return {0x01, permissions}; }
constexpr Entry user(std::uint32_t id, std::uint16_t permissions)
{
    return {0x02, permissions, id};
}
constexpr Entry owning_group(std::uint16_t permissions) { return {0x04, permissions}; }
constexpr Entry group(std::uint32_t id, std::uint16_t permissions)
{
    return {0x08, permissions, id};
}
constexpr Entry mask(std::uint16_t permissions) { return {0x10, permissions}; }
constexpr Entry other(std::uint16_t permissions) { return {0x20, permissions}; }

class PrivateFile : public testing::Test {
protected:
    PrivateFile()
    {
        std::string name =
            (std::filesystem::temp_directory_path() / "hapnet-private-XXXXXX").string();
        folder_ = mkdtemp(name.data());
        chmod(folder_.c_str(), 0755);
        path = folder_ / "secret";
        std::ofstream{path} << "secret";
        chmod(path.c_str(), 0600);
    }
    PrivateFile(const PrivateFile&) = delete;
    PrivateFile& operator=(const PrivateFile&) = delete;
    ~PrivateFile() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string complaint() const
    {
        const auto read = read_private(path, kind);
        return read ? "" : read.error().message;
    }

    /// Returns false if the file system has no such lists.
    [[nodiscard]] bool set_list(const std::vector<Entry>& entries) const
    {
        std::string bytes;
        const auto put = [&bytes](std::uint32_t number, int count) {
            for (int i = 0; i < count; ++i)
                bytes += static_cast<char>(number >> static_cast<unsigned>(8 * i) & 0xffU);
        };
        put(2, 4);
        for (const Entry& entry : entries) {
            put(entry.tag, 2);
            put(entry.permissions, 2);
            put(entry.id, 4);
        }
        const int set =
            setxattr(path.c_str(), "system.posix_acl_access", bytes.data(), bytes.size(), 0);
        EXPECT_TRUE(set == 0 || errno == EOPNOTSUPP) << errno;
        return set == 0;
    }

    std::string path;

private:
    std::filesystem::path folder_;
};

TEST_F(PrivateFile, IsRead) { EXPECT_EQ(read_private(path, kind).value(), "secret"); }

TEST_F(PrivateFile, MayBeBehindALinkWhereThatIsSaid)
{
    const std::string link = path + "-link";
    std::filesystem::create_symlink(path, link);
    EXPECT_FALSE(read_private(link, kind));
    const PrivateKind followed{
        .name = "token file", .bytes_max = 1024, .links = PrivateKind::Links::followed};
    EXPECT_EQ(read_private(link, followed).value(), "secret");
    ASSERT_EQ(chmod(path.c_str(), 0640), 0);
    EXPECT_EQ(read_private(link, followed).error().message,
              link + ": others may use this token file; run: chmod 600 " + link);
}

TEST_F(PrivateFile, IsNoneWhenItsListGivesItToAnotherUserOrAGroup)
{
    const std::vector<Entry> nothing{owner(6),        user(test::another_user, 0),
                                     owning_group(0), group(test::another_user, 0),
                                     mask(7),         other(0)};
    if (!set_list(nothing)) GTEST_SKIP() << "this file system has no access control lists";
    EXPECT_EQ(complaint(), "");
    const std::string refusal = path +
                                ": others may use this key file, by its access control list; run: "
                                "setfacl --remove-all " +
                                path + " && chmod 600 " + path;
    ASSERT_TRUE(
        set_list({owner(6), user(test::another_user, 4), owning_group(0), mask(4), other(0)}));
    EXPECT_EQ(complaint(), refusal);
    ASSERT_TRUE(set_list({owner(6), owning_group(4), mask(4), other(0)}));
    EXPECT_EQ(complaint(), refusal);
    ASSERT_TRUE(
        set_list({owner(6), owning_group(0), group(test::another_user, 2), mask(2), other(0)}));
    EXPECT_EQ(complaint(), refusal);
    ASSERT_TRUE(set_list({owner(6), user(geteuid(), 4), owning_group(0), mask(4), other(4)}));
    EXPECT_EQ(complaint(), refusal);
    // Rights that the mask removes are not granted.
    ASSERT_TRUE(
        set_list({owner(6), user(test::another_user, 4), owning_group(4), mask(0), other(0)}));
    EXPECT_EQ(complaint(), "");
    // The mask appears as the bits of the group: 0640.
    ASSERT_TRUE(set_list({owner(6), user(geteuid(), 4), owning_group(0), mask(4), other(0)}));
    struct stat status {};
    ASSERT_EQ(stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
    EXPECT_EQ(complaint(), "");
}

TEST_F(PrivateFile, MayBelongToRootAndBeGivenToThisUserByItsList)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a file of root's";
    const auto reads = [&](uid_t reader) {
        return test::as_user(reader, [&] {
            const auto read = read_private(path, kind);
            return read && *read == "secret" ? 0 : 1;
        });
    };
    // The list that systemd (254) gives a service's credentials.
    const std::vector<Entry> list{owner(4), user(test::another_user, 4), owning_group(0), mask(4),
                                  other(0)};
    if (!set_list(list)) GTEST_SKIP() << "this file system has no access control lists";
    EXPECT_EQ(reads(test::another_user), 0);
    EXPECT_EQ(reads(test::another_user + 1), 1);
    auto wide = list;
    wide.insert(wide.begin() + 2, user(test::another_user + 1, 4));
    ASSERT_TRUE(set_list(wide));
    EXPECT_EQ(reads(test::another_user), 1) << "a third user may read it";
}

TEST_F(PrivateFile, OfRootThatItsGroupMayReadIsNone)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a file of root's";
    ASSERT_EQ(chown(path.c_str(), 0, test::another_user), 0);
    ASSERT_EQ(chmod(path.c_str(), 0440), 0);
    EXPECT_EQ(test::as_user(test::another_user, [&] { return read_private(path, kind) ? 0 : 1; }),
              1);
}

TEST_F(PrivateFile, OfAnotherUserIsNone)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a file of another user";
    ASSERT_EQ(chown(path.c_str(), test::another_user, test::another_user), 0);
    EXPECT_EQ(complaint(),
              path + ": this key file belongs to another user; run: chown \"$(id -u)\" " + path);
}

} // namespace
} // namespace hapnet::disk
