#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pcrb_server/parameter_table.hpp"

namespace pcrb {

/// Reads a node's private parameters and collects every mistake, to list them all at once.
///
/// Names that are in no table and were not asked for are mistakes too: a misspelt parameter must
/// not be ignored in silence.
class NodeParameters {
 public:
  /// @param table  of all parameters that are read; a read of another is an error of the program.
  explicit NodeParameters(ParameterTable table);

  /// Text; like a path and words it must be there and not be empty where the table requires it.
  std::string string(const std::string& name);

  /// An absolute path, or none: roslaunch starts nodes in another folder than the user's.
  std::string path(const std::string& name);

  /// One of the words that the table allows.
  std::string choice(const std::string& name);

  bool boolean(const std::string& name);
  int integer(const std::string& name, int min, int max);

  /// A finite number; an integer parameter is accepted. NaN where it has no default and is not
  /// given.
  double number(const std::string& name, double min, double max);

  /// A list of words: a YAML list, or a string separated by commas or blanks.
  std::vector<std::string> words(const std::string& name);

  /// Takes the parameters that a launch file loaded from a user's file below ~group, too. One that
  /// is also given outside the group, as something that is neither its default nor the same, is a
  /// mistake. Call it before the first read.
  void addGroup(const std::string& group) { group_ = group; }

  /// Takes what is below ~group for the default of each parameter that has one there. Call it
  /// before the first read.
  void addDefaults(const std::string& group) { defaults_ = group; }

  /// Runs a check that throws pcrb::Error on a mistake, and keeps its message.
  void check(const std::function<void()>& statement);

  void addMistake(const std::string& mistake) { mistakes_.push_back(mistake); }

  /// Names a parameter that the node itself sets: one that an earlier start left is no mistake.
  void allowOwnParameter(const std::string& name) { asked_.insert(name); }

  /// Throws InvalidParameter with every mistake found so far and every private parameter whose name
  /// was never asked for; call it after the last read.
  void finish();

 private:
  const NodeParameter& entryOf(const std::string& name) const;
  std::string fallbackOf(const std::string& name) const;
  void requireValue(const std::string& name, bool is_empty);
  bool find(const std::string& name, XmlRpc::XmlRpcValue& value);
  bool findFormer(const std::string& name, XmlRpc::XmlRpcValue& value);
  bool findInGroup(const std::string& name, XmlRpc::XmlRpcValue& value);
  void checkNames();
  void mistake(const std::string& name, const XmlRpc::XmlRpcValue& found,
               const std::string& expected);

  ParameterTable table_;
  ros::NodeHandle node_;
  std::set<std::string> asked_;
  std::string group_;                            ///< empty: none
  std::string defaults_;                         ///< empty: none
  std::map<std::string, std::string> given_as_;  ///< former name, for those given under it
  std::vector<std::string> mistakes_;
};

}  // namespace pcrb
