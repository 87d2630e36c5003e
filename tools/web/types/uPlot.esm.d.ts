// The vendored file has the types of the package that it was taken from.
import uPlot from "uplot";
export default uPlot;
