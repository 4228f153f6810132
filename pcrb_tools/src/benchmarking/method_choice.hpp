#pragma once

#include <memory>
#include <optional>
#include <string>

#include "pcrb_core/registration/parameters.hpp"
#include "pcrb_core/registration/registration.hpp"
#include "pcrb_server/node_parameters.hpp"

namespace pcrb_tools {

/// The method that `registration_node` was asked for, with its parameter file and its plugin as
/// they are when it starts.
class MethodChoice {
 public:
  /// What a reader must have in its table.
  static const pcrb::ParameterTable& parameters();

  /// Reads ~method, ~plugin and ~parameters, tries the method with the parameters of every data
  /// set, and adds what is wrong to the reader's mistakes.
  explicit MethodChoice(pcrb::NodeParameters& reader);

  /// The method with the parameters of a data set.
  /// @param voxel_leaf  m, of the data set.
  std::unique_ptr<pcrb::Registration> make(const std::string& data_set, double voxel_leaf) const;

  /// Sets the node's parameter ~in_effect to what the results depend on, so that the server, which
  /// compares the parameters of a run's client, sees an edited file or a rebuilt plugin. One
  /// `name: value` a line: all parameters of the method, defaults included; `data_set/name` for
  /// what is different there; the hash of the plugin's file.
  void announce() const;

 private:
  void check() const;
  std::string inEffect() const;

  std::string method_;
  std::string plugin_;
  std::string file_;
  std::optional<pcrb::MethodParameters> parameters_;
};

}  // namespace pcrb_tools
