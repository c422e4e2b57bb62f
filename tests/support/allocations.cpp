// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/allocations.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#if defined HAPNET_SANITIZED
// As in sanitizer/allocator_interface.h, which GCC 12 does not install.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));
#endif

namespace {

std::atomic<std::uint64_t> count{0};

} // namespace

#if defined HAPNET_SANITIZED

namespace {

// ThreadSanitizer's own new cannot be replaced where it is linked statically; its hook also counts
// malloc().
const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void* /*memory*/, std::size_t /*size*/) {
        count.fetch_add(1, std::memory_order_relaxed);
    },
    [](const volatile void* /*memory*/) {});

} // namespace

#else

// NOLINTBEGIN(cppcoreguidelines-no-malloc): this is where new and delete are made.
// Not inline: GCC would see malloc() on one side and delete on the other, and object.
[[gnu::noinline]] void* operator new(std::size_t size)
{
    count.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc{};
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept
{
    count.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept
{
    std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

#endif

namespace hapnet::test {

std::uint64_t allocations() { return count.load(std::memory_order_relaxed); }

} // namespace hapnet::test
