// SPDX-License-Identifier: MIT OR Apache-2.0
#include "plugin_2020.h"

#include "filters.h"

using namespace fairmesh_meshlab;

FairmeshPlugin::FairmeshPlugin() {
    for (int filter : FILTERS) {
        typeList.append(filter);
        actionList.append(new QAction(filterName(filter), this));
    }
}

QString FairmeshPlugin::pluginName() const { return "FilterFairmesh"; }
QString FairmeshPlugin::filterName(FilterIDType filter) const { return name(filter); }
QString FairmeshPlugin::filterInfo(FilterIDType filter) const { return help(filter); }
MeshFilterInterface::FilterClass FairmeshPlugin::getClass(QAction *action) { return static_cast<FilterClass>(menus(ID(action))); }
int FairmeshPlugin::getPreConditions(QAction *action) const { return needs(ID(action)); }
int FairmeshPlugin::postCondition(QAction *action) const { return changes(ID(action)); }

void FairmeshPlugin::initParameterSet(QAction *action, MeshDocument &, RichParameterList &list) {
    for (const RichParameter &parameter : parameters(ID(action))) list.addParam(parameter);
}

bool FairmeshPlugin::applyFilter(QAction *action, MeshDocument &document, const RichParameterList &asked, vcg::CallBackPos *progress) {
    const Host host = {progress, [this](const std::string &line) { Log(GLLogStream::FILTER, line); },
                       [this](const std::string &line) { Log(GLLogStream::WARNING, line); }};
    try {
        apply(ID(action), document.mm(), asked, host);
        return true;
    } catch (const std::exception &why) {
        errorMessage = QString::fromUtf8(why.what());
    } catch (...) {
        errorMessage = "An unknown error.";
    }
    // meshlabserver does not print errorMessage.
    Log(GLLogStream::WARNING, errorMessage.toStdString());
    return false;
}
