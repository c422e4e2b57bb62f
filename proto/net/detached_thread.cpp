// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/detached_thread.hpp"

#include <memory>
#include <pthread.h>
#include <system_error>
#include <utility>

namespace hapnet::net {

namespace {

constexpr std::size_t detached_stack_bytes = std::size_t{512} << 10;

void* run_detached(void* work)
{
    const std::unique_ptr<std::function<void()>> owned{static_cast<std::function<void()>*>(work)};
    (*owned)();
    return nullptr;
}

} // namespace

void start_detached(std::function<void()> work)
{
    auto owned = std::make_unique<std::function<void()>>(std::move(work));
    pthread_attr_t attributes{};
    pthread_attr_init(&attributes);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    pthread_attr_setstacksize(&attributes, detached_stack_bytes);
    pthread_t thread{};
    const int error = pthread_create(&thread, &attributes, run_detached, owned.get());
    pthread_attr_destroy(&attributes);
    if (error != 0) throw std::system_error{error, std::generic_category(), "pthread_create"};
    std::ignore = owned.release(); // the thread owns it now
}

} // namespace hapnet::net
