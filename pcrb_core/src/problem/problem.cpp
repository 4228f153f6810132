#include "pcrb_core/problem/problem.hpp"

#include "pcrb_core/error.hpp"
#include "pcrb_core/io/text_rows.hpp"

namespace pcrb {

const char* toString(Kind kind) { return kind == Kind::kLocal ? "local" : "global"; }

Kind kindFromString(const std::string& text) {
  if (text == "local") return Kind::kLocal;
  if (text == "global") return Kind::kGlobal;
  throw InvalidParameter("kind: found " + inQuotes(text) + ", expected 'local' or 'global'");
}

}  // namespace pcrb
