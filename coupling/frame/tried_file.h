#pragma once

#include "fem/process/reading_limits.h"

#include <functional>
#include <mutex>
#include <string>

namespace gestell::coupling
{

/// A lock for the use of HDF5, which has one internal lock that a child must not inherit from another thread.
std::unique_lock<std::mutex> hdf5_alone();

/**
 * Reads a file in a forked child first, once per process for an unchanged file, so that a crash of HDF5, which trusts
 * the addresses in a file, becomes a message. (A checksum detects damage, not forgery.) hdf5_alone() is locked.
 *
 * @param phase   activity for the message: "reading the frame"
 * @param defect  reads the file and returns why it cannot be read, or ""
 * @return the result of `defect`; "" if GESTELL_ONE_PROCESS forbids a child
 * @throws std::invalid_argument if the child dies or does not end, with the remedy; std::runtime_error if it cannot be
 * created
 */
std::string defect_in_child(const std::string &file, const std::string &phase, const fem::ReadingLimits &limits,
                            const std::function<std::string()> &defect);

} // namespace gestell::coupling
