// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/umockdev/handler.hpp"

#include "proto/base/ensure.hpp"

#include <stdexcept>
#include <umockdev.h>
#include <utility>
#include <vector>

namespace hapnet::umockdev {

namespace {

gboolean pass_ioctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer handler)
{
    return static_cast<gboolean>(static_cast<Handler*>(handler)->on_ioctl(Request{client}));
}

gboolean pass_read(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer handler)
{
    return static_cast<gboolean>(static_cast<Handler*>(handler)->on_read(Request{client}));
}

gboolean pass_write(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer handler)
{
    return static_cast<gboolean>(static_cast<Handler*>(handler)->on_write(Request{client}));
}

void pass_closed(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, gpointer handler)
{
    static_cast<Handler*>(handler)->on_closed(client);
}

UMockdevIoctlData* argument_of(UMockdevIoctlClient* client)
{
    return umockdev_ioctl_client_get_arg(client);
}

} // namespace

Memory::Memory(UMockdevIoctlData* owned)
{
    if (owned != nullptr) data_.reset(owned, [](UMockdevIoctlData* data) { g_object_unref(data); });
}

unsigned long Memory::address() const { return data_ ? data_->client_addr : 0; }

std::span<const std::byte> Memory::bytes() const
{
    if (!data_) return {};
    return std::as_bytes(std::span{data_->data, static_cast<std::size_t>(data_->data_len)});
}

void Memory::write(std::size_t offset, std::span<const std::byte> bytes)
{
    if (!data_ || bytes.empty()) return;
    base::ensure(offset + bytes.size() <= this->bytes().size());
    // The library takes constant data by a non-const pointer.
    std::vector<guint8> copy(bytes.size());
    std::memcpy(copy.data(), bytes.data(), bytes.size());
    umockdev_ioctl_data_update(data_.get(), offset, copy.data(), static_cast<gint>(copy.size()));
}

Memory Memory::pointed_to(std::size_t offset, std::size_t size) const
{
    if (!data_) return {};
    return Memory{umockdev_ioctl_data_resolve(data_.get(), offset, size, nullptr)};
}

void Memory::point_to(std::size_t offset, const Memory& other)
{
    if (data_ && other) umockdev_ioctl_data_set_ptr(data_.get(), offset, other.data_.get());
}

Request::Request(UMockdevIoctlClient* client)
    : client_{static_cast<UMockdevIoctlClient*>(g_object_ref(client)),
              [](UMockdevIoctlClient* held) { g_object_unref(held); }}
{}

unsigned long Request::code() const { return umockdev_ioctl_client_get_request(client_.get()); }

unsigned long Request::number() const
{
    unsigned long value = 0;
    std::memcpy(&value, argument_of(client_.get())->data, sizeof value);
    return value;
}

Memory Request::argument(std::size_t size) const
{
    return Memory{umockdev_ioctl_data_resolve(argument_of(client_.get()), 0, size, nullptr)};
}

Memory Request::buffer() const
{
    return Memory{umockdev_ioctl_data_ref(argument_of(client_.get()))};
}

void Request::succeed(long result) const
{
    umockdev_ioctl_client_complete(client_.get(), result, 0);
}

void Request::fail(int error) const { umockdev_ioctl_client_complete(client_.get(), -1, error); }

Handler::Handler()
    : base_{umockdev_ioctl_base_new(), [](UMockdevIoctlBase* b) { g_object_unref(b); }}
{
    g_signal_connect(base_.get(), "handle-ioctl", G_CALLBACK(pass_ioctl), this);
    g_signal_connect(base_.get(), "handle-read", G_CALLBACK(pass_read), this);
    g_signal_connect(base_.get(), "handle-write", G_CALLBACK(pass_write), this);
    g_signal_connect(base_.get(), "client-vanished", G_CALLBACK(pass_closed), this);
}

Handler::~Handler() { g_signal_handlers_disconnect_by_data(base_.get(), this); }

Attachment::Attachment(Testbed& testbed, std::string node, Handler& handler)
    : testbed_{testbed}, node_{std::move(node)}
{
    GError* error = nullptr;
    if (umockdev_testbed_attach_ioctl(testbed_.raw(), node_.c_str(), handler.raw(), &error) !=
        FALSE) {
        return;
    }
    const std::string reason = error != nullptr ? error->message : "no reason given";
    g_clear_error(&error);
    throw std::runtime_error{node_ + ": " + reason};
}

Attachment::~Attachment() { umockdev_testbed_detach_ioctl(testbed_.raw(), node_.c_str(), nullptr); }

} // namespace hapnet::umockdev
