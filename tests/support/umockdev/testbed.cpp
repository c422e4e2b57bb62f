// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/umockdev/testbed.hpp"

#include <stdexcept>
#include <umockdev.h>

namespace hapnet::umockdev {

Testbed::Testbed() : testbed_{umockdev_testbed_new(), [](UMockdevTestbed* t) { g_object_unref(t); }}
{
    // Ask only now, because umockdev keeps the answer, which is no without a testbed.
    if (umockdev_in_mock_environment() == FALSE) {
        throw std::runtime_error{"libumockdev-preload.so.0 is not loaded: is it installed?"};
    }
}

void Testbed::add(const std::string& description)
{
    GError* error = nullptr;
    if (umockdev_testbed_add_from_string(raw(), description.c_str(), &error) != FALSE) return;
    const std::string reason = error != nullptr ? error->message : "no reason given";
    g_clear_error(&error);
    throw std::runtime_error{"the device's description: " + reason};
}

void Testbed::remove(const std::string& path)
{
    umockdev_testbed_remove_device(raw(), path.c_str());
}

void Testbed::announce(const std::string& path, const std::string& action)
{
    umockdev_testbed_uevent(raw(), path.c_str(), action.c_str());
}

std::string Testbed::real_path(const std::string& path) const
{
    char* const root = umockdev_testbed_get_root_dir(raw());
    const std::string real = root + path;
    g_free(root);
    return real;
}

int Testbed::master_of(const std::string& node) const
{
    return umockdev_testbed_get_dev_fd(raw(), node.c_str());
}

} // namespace hapnet::umockdev
