// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/keys/files.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace hapnet::secure::keys {

namespace {

constexpr off_t bytes_max = off_t{64} << 10;
constexpr mode_t others = 077;

/// Closes it.
class Descriptor {
public:
    explicit Descriptor(int number) : number_{number} {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor()
    {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool is_open() const { return number_ >= 0; }

private:
    int number_;
};

/// Text that is overwritten before its memory is given back.
class SecretText {
public:
    explicit SecretText(std::string text) : text_{std::move(text)} {}
    SecretText(const SecretText&) = delete;
    SecretText& operator=(const SecretText&) = delete;
    ~SecretText() { wipe(std::as_writable_bytes(std::span{text_})); }
    [[nodiscard]] std::string& text() { return text_; }

private:
    std::string text_;
};

std::string complaint(const struct stat& status, const std::string& path)
{
    if (!S_ISREG(status.st_mode)) return fmt::format("{}: a key file is a regular file", path);
    if (status.st_uid != ::geteuid()) {
        return fmt::format("{}: this key file belongs to another user; run: chown \"$(id -u)\" {}",
                           path, path);
    }
    if ((status.st_mode & others) != 0) {
        return fmt::format("{}: others may use this key file; run: chmod 600 {}", path, path);
    }
    if (status.st_size > bytes_max) return fmt::format("{}: larger than 64 KiB", path);
    return {};
}

void write_new(const std::string& path, std::string text)
{
    const auto fail = [&path] {
        throw std::system_error{errno, std::generic_category(), fmt::format("write {}", path)};
    };
    const Descriptor descriptor{
        ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600)};
    if (!descriptor.is_open()) fail();
    SecretText secret{std::move(text)};
    std::string_view left = secret.text();
    while (!left.empty()) {
        const ssize_t written = ::write(descriptor.number(), left.data(), left.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            const int reason = errno;
            ::unlink(path.c_str());
            errno = reason;
            fail();
        }
        left.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::fsync(descriptor.number()) != 0) fail();
}

/// What `parse` makes of the text of a file that only its owner can read.
template <typename Parse>
std::invoke_result_t<Parse, std::string_view> read_secret(const std::string& path, Parse parse)
{
    const Descriptor descriptor{
        ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK)};
    if (!descriptor.is_open()) {
        const std::string_view why =
            errno == ELOOP ? "it is a symbolic link; name the file itself" : std::strerror(errno);
        return base::fail(fmt::format("cannot read {}: {}", path, why));
    }
    struct stat status {};
    if (::fstat(descriptor.number(), &status) != 0)
        return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    if (const std::string why = complaint(status, path); !why.empty()) return base::fail(why);
    SecretText text{std::string(static_cast<std::size_t>(status.st_size), '\0')};
    std::size_t size = 0;
    while (size < text.text().size()) {
        const ssize_t got =
            ::read(descriptor.number(), text.text().data() + size, text.text().size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    return parse(std::string_view{text.text()}.substr(0, size));
}

} // namespace

base::Result<KeyFile> read_key_file(const std::string& path)
{
    return read_secret(path, [&](std::string_view text) { return parse_key_file(text, path); });
}

base::Result<Secret> read_shared_key(const std::string& path)
{
    return read_secret(path, [&](std::string_view text) { return parse_shared_key(text, path); });
}

void write_key_file(const std::string& path, const KeyFile& file)
{
    write_new(path, print_key_file(file));
}

void write_shared_key(const std::string& path, const Secret& key)
{
    write_new(path, print_shared_key(key));
}

void replace_key_file(const std::string& path, const KeyFile& file)
{
    const std::string beside = fmt::format("{}.{}.partial", path, ::getpid());
    ::unlink(beside.c_str());
    write_new(beside, print_key_file(file));
    if (::rename(beside.c_str(), path.c_str()) == 0) return;
    const int reason = errno;
    ::unlink(beside.c_str());
    throw std::system_error{reason, std::generic_category(), fmt::format("write {}", path)};
}

} // namespace hapnet::secure::keys
