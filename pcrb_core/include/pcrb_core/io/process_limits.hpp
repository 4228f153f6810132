#pragma once

#include <exception>
#include <string>

namespace pcrb {

/// Makes what a process may not exceed an error like others: a write beyond the longest file
/// (`ulimit -f`) fails instead of ending the process by a signal, and an exception that nobody
/// catches, as where a thread of a library finds no memory (`ulimit -v`), is said in one line and
/// ends the process with status 1. Call first in a program; `program` begins the line.
void turnLimitsIntoErrors(const std::string& program);

/// What to say of an exception that ends a program, in words also where memory has run out.
std::string describeFailure(const std::exception& error);

}  // namespace pcrb
