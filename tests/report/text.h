// Pieces of text for the page, the plots and the files beside them.
#pragma once

#include <string>

namespace collision::report {

/// At most four significant digits: "12.3", "1.2e-07", "166000".
std::string Short(double value);
/// For a sentence, so many significant digits: "2.13", "1e-07", "35,100".
std::string Rounded(double value, int digits = 3);
/// A count: "166,000".
std::string Grouped(double value);
/// "12 ns", "3.4 µs", "1.2 s", "2 min 5 s".
std::string Duration(double seconds);

/// Throw std::runtime_error that names the file.
std::string ReadFile(const std::string& path);
void WriteFile(const std::string& path, const std::string& text);

}  // namespace collision::report
