// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/unix_socket.hpp"

#include "proto/net/cure.hpp"
#include "proto/net/wait_set.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <system_error>

namespace hapnet::net {
namespace {

/// A path for a socket in a folder of its own.
class Place {
public:
    Place()
    {
        std::string pattern = std::filesystem::temp_directory_path() / "hapnet-XXXXXX";
        folder_ = mkdtemp(pattern.data());
    }
    ~Place() { std::filesystem::remove_all(folder_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    [[nodiscard]] std::string path() const { return folder_ + "/socket"; }

private:
    std::string folder_;
};

int error_of(const std::string& path)
{
    try {
        const UnixListener listener{path};
    } catch (const std::system_error& error) {
        EXPECT_NE(std::string{error.what()}.find(path), std::string::npos) << error.what();
        EXPECT_EQ(explained(error).find(" port"), std::string::npos) << explained(error);
        return error.code().value();
    }
    return 0;
}

std::string refusal_of(const std::string& path)
{
    try {
        const UnixListener listener{path};
    } catch (const std::system_error& error) {
        return explained(error);
    }
    return "";
}

TEST(UnixListener, IsForItsOwnerAloneAndGoesWithItsObject)
{
    const Place place;
    {
        const UnixListener listener{place.path()};
        struct stat found {};
        ASSERT_EQ(lstat(place.path().c_str(), &found), 0);
        EXPECT_EQ(found.st_mode & 0777U, 0600U);
    }
    EXPECT_FALSE(std::filesystem::exists(place.path()));
}

TEST(UnixListener, ReplacesASocketThatNobodyAnswersOnAndNothingElse)
{
    const Place place;
    const std::string other = place.path() + "2";
    {
        const UnixListener gone{place.path()};
        std::filesystem::rename(place.path(), other); // so the socket file stays behind
    }
    EXPECT_EQ(error_of(other), 0);
    const UnixListener living{place.path()};
    EXPECT_EQ(error_of(place.path()), EADDRINUSE);
    EXPECT_EQ(refusal_of(place.path()),
              "cannot listen on " + place.path() +
                  ": another emulator or peer serves it: end that one, or choose another path");
    std::ofstream{other} << "text";
    EXPECT_EQ(error_of(other), EEXIST);
    EXPECT_EQ(error_of(place.path() + std::string(200, 'x')), ENAMETOOLONG);
    EXPECT_EQ(error_of("/no/such/folder/socket"), ENOENT);
}

TEST(UnixStream, MovesBytesBothWaysAndTellsWhenTheOtherSideHasGone)
{
    const Place place;
    UnixListener listener{place.path()};
    EXPECT_FALSE(listener.accept());
    auto client = UnixStream::connect(place.path());
    auto server = listener.accept();
    ASSERT_TRUE(server);
    std::array<char, 8> buffer{};
    EXPECT_EQ(server->read(buffer).state, Transfer::State::later);
    EXPECT_EQ(client.write("abc").bytes, 3U);
    EXPECT_EQ(server->read(buffer).bytes, 3U);
    EXPECT_EQ((std::string_view{buffer.data(), 3}), "abc");

    WaitSet set;
    set.add(server->descriptor(), 7, {.to_read = true});
    EXPECT_TRUE(set.ready().empty());
    set.change(server->descriptor(), 7, {.to_read = true, .to_write = true});
    ASSERT_EQ(set.ready().size(), 1U);
    {
        const auto leaves = std::move(client);
    }
    const auto ready = set.ready();
    ASSERT_EQ(ready.size(), 1U);
    EXPECT_EQ(ready[0].key, 7U);
    EXPECT_TRUE(ready[0].is_readable && ready[0].is_gone);
    EXPECT_EQ(server->read(buffer).state, Transfer::State::ended);
    EXPECT_EQ(server->write("abc").state, Transfer::State::gone);
}

TEST(UnixStream, SaysThatNobodyAnswers)
{
    EXPECT_THROW(std::ignore = UnixStream::connect("/no/such/socket"), std::system_error);
}

} // namespace
} // namespace hapnet::net
