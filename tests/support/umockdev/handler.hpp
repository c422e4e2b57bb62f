// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/umockdev/testbed.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

// NOLINTBEGIN(bugprone-reserved-identifier): their library's names for them
typedef struct _UMockdevIoctlBase UMockdevIoctlBase;
typedef struct _UMockdevIoctlClient UMockdevIoctlClient;
typedef struct _UMockdevIoctlData UMockdevIoctlData;
// NOLINTEND(bugprone-reserved-identifier)

namespace hapnet::umockdev {

/// A piece of a program's memory that belongs to a request, as a copy; what is written to it is in
/// the program's memory once the request, or a later one that refers to it, is answered. Empty when
/// the program has gone meanwhile.
class Memory {
public:
    Memory() = default;
    explicit Memory(UMockdevIoctlData* owned); // or none

    /// Returns its address in the program.
    [[nodiscard]] unsigned long address() const;
    [[nodiscard]] std::span<const std::byte> bytes() const;
    void write(std::size_t offset, std::span<const std::byte> bytes);

    template <typename T>
    [[nodiscard]] T as() const
    {
        static_assert(std::is_trivially_copyable_v<T>);
        T value; // Clang takes {} for the end of a urb, an array of no length, ill
        std::memset(&value, 0, sizeof value);
        std::memcpy(&value, bytes().data(), std::min(sizeof(T), bytes().size()));
        return value;
    }
    template <typename T>
    void write_as(const T& value, std::size_t offset = 0)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        write(offset, std::as_bytes(std::span{&value, 1}));
    }

    /// The `size` bytes to which the pointer at `offset` points.
    [[nodiscard]] Memory pointed_to(std::size_t offset, std::size_t size) const;
    /// Makes the pointer at `offset` point to `other`.
    void point_to(std::size_t offset, const Memory& other);

    [[nodiscard]] explicit operator bool() const { return data_ != nullptr; }

private:
    std::shared_ptr<UMockdevIoctlData> data_;
};

/// A program's request to a device node. It waits until the one answer, now or later.
class Request {
public:
    explicit Request(UMockdevIoctlClient* client);

    /// Returns the code of an ioctl, as in the kernel's headers.
    [[nodiscard]] unsigned long code() const;
    /// Returns the argument of an ioctl that takes a number.
    [[nodiscard]] unsigned long number() const;
    /// The memory that the argument points to: for an ioctl `size` bytes, otherwise the buffer.
    [[nodiscard]] Memory argument(std::size_t size) const;
    [[nodiscard]] Memory buffer() const;
    /// Returns the opener: one for each time that the node was opened.
    [[nodiscard]] const void* opener() const { return client_.get(); }

    void succeed(long result = 0) const;
    /// Fails with an error number such as ENODEV.
    void fail(int error) const;

private:
    std::shared_ptr<UMockdevIoctlClient> client_;
};

/// Answers the requests of programs to one device node. The functions are called from one thread of
/// umockdev, the same for all nodes of a testbed. If one returns false, the kernel, or umockdev in
/// its place, answers.
class Handler {
public:
    Handler();
    virtual ~Handler();
    Handler(const Handler&) = delete;
    Handler& operator=(const Handler&) = delete;

    [[nodiscard]] virtual bool on_ioctl(const Request& /*request*/) { return false; }
    [[nodiscard]] virtual bool on_read(const Request& /*request*/) { return false; }
    [[nodiscard]] virtual bool on_write(const Request& /*request*/) { return false; }
    /// Closed, or its program has ended.
    virtual void on_closed(const void* /*opener*/) {}

    [[nodiscard]] UMockdevIoctlBase* raw() const { return base_.get(); }

private:
    std::shared_ptr<UMockdevIoctlBase> base_;
};

/// A handler at its node, as long as this lives; both outlive it.
class Attachment {
public:
    Attachment(Testbed& testbed, std::string node, Handler& handler);
    ~Attachment();
    Attachment(const Attachment&) = delete;
    Attachment& operator=(const Attachment&) = delete;

private:
    Testbed& testbed_;
    std::string node_;
};

} // namespace hapnet::umockdev
