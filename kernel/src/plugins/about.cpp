// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/about.hpp"

namespace velum {
namespace {

void name_port(std::vector<Port>& ports, std::size_t& named, std::string name, std::string doc) {
  if (named == ports.size()) throw Error(Fault::plugin, "more ports named than the call has");
  ports[named].name = std::move(name);
  ports[named++].doc = std::move(doc);
}

Port& find_port(std::vector<Port>& ports, std::string_view name) {
  for (Port& port : ports)
    if (port.name == name) return port;
  throw Error(Fault::plugin, "no port '" + std::string(name) + "'");
}

}  // namespace

Parameter detail::named(std::string name, std::string doc, ParameterType type) {
  Parameter parameter;
  parameter.name = std::move(name);
  parameter.doc = std::move(doc);
  parameter.type = type;
  return parameter;
}

AboutStage::AboutStage(const std::type_info& stage, std::string summary, std::vector<Port> inputs,
                       std::vector<Port> outputs)
    : stage_(stage) {
  info_.summary = std::move(summary);
  info_.inputs = std::move(inputs);
  info_.outputs = std::move(outputs);
  info_.cacheable = !info_.outputs.empty();
}

AboutStage& AboutStage::in(std::string name, std::string doc) {
  name_port(info_.inputs, named_inputs_, std::move(name), std::move(doc));
  return *this;
}

AboutStage& AboutStage::out(std::string name, std::string doc) {
  name_port(info_.outputs, named_outputs_, std::move(name), std::move(doc));
  return *this;
}

AboutStage& AboutStage::needs(std::string_view input, std::string column) {
  return needs_when({}, {}, input, std::move(column));
}

AboutStage& AboutStage::needs_when(std::string parameter, std::string value, std::string_view input,
                                   std::string column) {
  find_port(info_.inputs, input)
      .columns.push_back({std::move(column), std::move(parameter), std::move(value)});
  return *this;
}

AboutStage& AboutStage::adds(std::string_view output, std::string column) {
  find_port(info_.outputs, output).columns.push_back({std::move(column), {}, {}});
  return *this;
}

AboutStage& AboutStage::drops_columns() {
  info_.keeps_columns = false;
  return *this;
}

AboutStage& AboutStage::required() {
  last().required = true;
  return *this;
}

AboutStage& AboutStage::advanced() {
  last().advanced = true;
  return *this;
}

AboutStage& AboutStage::was(std::string old_name) {
  last().old_names.push_back(std::move(old_name));
  return *this;
}

AboutStage& AboutStage::of(std::string input) {
  last().relative_to = std::move(input);
  return *this;
}

AboutStage& AboutStage::unit(std::string unit) {
  last().unit = std::move(unit);
  return *this;
}

AboutStage& AboutStage::deterministic() {
  info_.determinism = Determinism::bitwise;
  return *this;
}

AboutStage& AboutStage::seeded() {
  info_.determinism = Determinism::seeded;
  return *this;
}

AboutStage& AboutStage::tolerant() {
  info_.determinism = Determinism::tolerance;
  return *this;
}

AboutStage& AboutStage::nondeterministic() {
  info_.determinism = Determinism::none;
  return uncached();
}

AboutStage& AboutStage::uncached() {
  info_.cacheable = false;
  return *this;
}

AboutStage& AboutStage::isolated() {
  info_.isolated = true;
  return *this;
}

AboutStage& AboutStage::version(std::string version) {
  info_.version = std::move(version);
  return *this;
}

AboutStage& AboutStage::reference(std::string citation) {
  info_.references.push_back(std::move(citation));
  return *this;
}

AboutStage& AboutStage::licence(std::string licence) {
  info_.licence = std::move(licence);
  return *this;
}

AboutStage& AboutStage::add(const std::type_info& owner, Parameter parameter) {
  if (stage_ != owner)
    throw Error(Fault::plugin, "the parameter '" + parameter.name + "' is no member of the stage");
  info_.parameters.push_back(std::move(parameter));
  return *this;
}

Parameter& AboutStage::last() {
  if (info_.parameters.empty()) throw Error(Fault::plugin, "no parameter to speak of");
  return info_.parameters.back();
}

}  // namespace velum
